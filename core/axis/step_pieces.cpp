#include "core/axis/step_pieces.hpp"

#include <algorithm>
#include <utility>

#include "core/motion/interpolate.hpp"

namespace lockstep {

/// False, and nothing changed, where no speed makes this step and those in hand at their ticks.
bool StepPieces::take(Ticks at) {
    const Int128 ticks = (at - begin_).value;
    const Int128 way = (steps_ + 1) * kOneStep - beyond_;
    const Int128 slowest = std::max(slowest_, (way + ticks - 1) / ticks);
    const Int128 fastest = std::min(fastest_, (way + ticks - 2) / (ticks - 1) - 1);
    if (slowest > fastest) { return false; }
    slowest_ = slowest;
    fastest_ = fastest;
    last_ = at;
    ++steps_;
    return true;
}

std::optional<Piece> StepPieces::add(Ticks at) {
    if (take(at)) { return std::nullopt; }
    const auto before = cut();
    (void)take(at);  // alone it fits: its range is wider than one unit
    return before;
}

std::optional<Piece> StepPieces::cut() {
    if (steps_ == 0) { return std::nullopt; }
    const Piece piece{last_ - begin_, {static_cast<std::int64_t>(slowest_)}, {}};
    beyond_ += piece.covered().raw - steps_ * kOneStep;
    speed_ = piece.velocity.raw;
    start_anew();
    return piece;
}

void StepPieces::start_anew() {
    begin_ = last_;
    steps_ = 0;
    slowest_ = 0;
    fastest_ = kFastest;
}

Piece StepPieces::last_half() const {
    const Int128 way = kHalfStep - beyond_;
    const auto ticks = static_cast<std::int64_t>(std::max<Int128>(1, (way + speed_ - 1) / speed_));
    return solve_piece({}, Position{way}, {ticks}, 0);
}

}  // namespace lockstep
