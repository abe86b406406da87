#include "core/axis/own_moves/step_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/interpolate.hpp"

namespace lockstep {

/// Adds a step to the piece in hand. Returns false and changes nothing if no speed makes all its steps at their ticks.
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

std::optional<Piece> StepPieces::add(double ticks) {
    const Ticks at = std::max(Ticks{std::llround(ticks)}, last_ + kLeastTicks);
    std::optional<Piece> before;
    if (!take(at)) {
        before = cut(1 / std::max(1.0, ticks - asked_));
        (void)take(at);  // alone it fits: its range is wider than one unit
    }
    asked_ = ticks;
    return before;
}

std::optional<Piece> StepPieces::cut() {
    if (steps_ == 0) { return std::nullopt; }
    return cut(static_cast<double>(slowest_) * 0x1p-64);
}

/// Chooses the speed so that steps are made at the asked part of their ticks, for example in the middle. The next
/// piece, which continues at `next_speed`, then begins where the asked motion is, and fits as many steps of that speed
/// as there are.
Piece StepPieces::cut(double next_speed) {
    const Int128 ticks = (last_ - begin_).value;
    const double since_step = static_cast<double>(last_.value) - (asked_ - 0.5);
    const auto beyond = static_cast<Int128>(since_step * next_speed * 0x1p64);
    const Int128 way = steps_ * kOneStep - beyond_;
    const Int128 speed = std::clamp((way + beyond) / ticks, slowest_, fastest_);
    made_ = static_cast<std::int64_t>(speed);
    beyond_ = speed * ticks - way;
    begin_ = last_;
    steps_ = 0;
    slowest_ = 0;
    fastest_ = kFastest;
    return {{static_cast<std::int64_t>(ticks)}, {made_}, {}};
}

Piece StepPieces::last_half() const {
    const Int128 way = kHalfStep - beyond_;
    const auto ticks = static_cast<std::int64_t>(std::max<Int128>(1, (way + made_ - 1) / made_));
    return solve_piece({}, Position{way}, {ticks}, 0);
}

}  // namespace lockstep
