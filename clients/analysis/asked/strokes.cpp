#include "clients/analysis/asked/strokes.hpp"

#include <algorithm>
#include <optional>

namespace lockstep::analysis {
namespace {

/// Joins counts to strokes.
class StrokeMaker {
public:
    using Visit = std::function<void(const PlannedStroke&)>;
    StrokeMaker(std::int64_t from, Ticks begin, const Visit& visit) : visit_(visit), now_{from, from, begin, begin} {}

    void go_to(std::int64_t count, Ticks at) {
        const bool goes_on = now_.to == now_.from || (count > now_.to) == (now_.to > now_.from) || count == now_.to;
        if (!goes_on) { end(); }
        if (count != now_.to || now_.to == now_.from) { now_.end = at; }
        now_.to = count;
    }
    void end() {
        if (now_.to != now_.from) { visit_(now_); }
        now_ = {now_.to, now_.to, now_.end, now_.end};
    }

private:
    const Visit& visit_;
    PlannedStroke now_;
};

/// The tick of a piece after which it moves the other way; nullopt if it does not reverse.
std::optional<Ticks> reversal_of(const Piece& piece) {
    const Int128 first = piece.velocity_after(Ticks{1});
    const Int128 last = piece.velocity_after(piece.ticks);
    if (first == 0 || last == 0 || (first > 0) == (last > 0)) { return std::nullopt; }
    const Int128 ticks = -Int128{piece.velocity.raw} / piece.acceleration.raw;
    return Ticks{static_cast<std::int64_t>(ticks)};
}

}  // namespace

void each_stroke(const AxisMotion& motion, Ticks begin, Ticks end,
                 const std::function<void(const PlannedStroke&)>& visit) {
    StrokeMaker strokes(motion.at(begin).count(), begin, visit);
    const auto& pieces = motion.pieces();
    auto piece = std::ranges::upper_bound(pieces, begin, {}, &AxisMotion::TimedPiece::begin);
    if (piece != pieces.begin()) { --piece; }
    for (; piece != pieces.end() && piece->begin < end; ++piece) {
        const auto count_at = [&](Ticks t) { return (piece->from + piece->piece.covered(t)).count(); };
        const Ticks from = std::max(begin - piece->begin, Ticks{});
        const Ticks to = std::min(end - piece->begin, piece->piece.ticks);
        if (const auto reversal = reversal_of(piece->piece)) {
            for (const Ticks t : {*reversal - Ticks{1}, *reversal, *reversal + Ticks{1}}) {
                if (from < t && t < to) { strokes.go_to(count_at(t), piece->begin + t); }
            }
        }
        if (from < to) { strokes.go_to(count_at(to), piece->begin + to); }
    }
    strokes.end();
}

}  // namespace lockstep::analysis
