#include "core/axis/retime.hpp"

#include <algorithm>
#include <cmath>

#include "core/clock/clock_view.hpp"

namespace lockstep {
namespace {

Int128 rounded_quotient(Int128 value, Int128 by) {
    const Int128 half = by / 2;
    return (value >= 0 ? value + half : value - half) / by;
}

/// The piece of so many ticks that covers as much, but for what rounding leaves: less than `ticks`.
Piece solved(const Piece& piece, Displacement covers, Ticks ticks) {
    const double slower = static_cast<double>(piece.ticks.value) / static_cast<double>(ticks.value);
    const double acceleration = static_cast<double>(piece.acceleration.raw) * slower * slower;
    Piece result{ticks, {}, {std::llround(acceleration)}};
    const Int128 by_speed = covers.raw - result.covered().raw;
    result.velocity.raw = static_cast<std::int64_t>(rounded_quotient(by_speed, ticks.value));
    return result;
}

/// One tick that covers just so much.
Piece tick_of(Displacement covers) { return {{1}, {static_cast<std::int64_t>(covers.raw)}, {}}; }

}  // namespace

template <std::size_t Capacity>
bool retime(StaticVector<Piece, Capacity>& pieces, const Retiming& when) {
    StaticVector<Piece, Capacity> result;
    const ClockStretch stretch{
        .from = {}, .ticks = total_ticks(pieces), .other_from = when.start, .other_ticks = when.end - when.start};
    Tick gone;  // ticks of the pieces as they are
    Tick device = when.start;
    Displacement left;  // of what the pieces so far should have covered
    bool fits = true;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const bool last = i + 1 == pieces.size();
        gone += piece.ticks;
        const Ticks needed{static_cast<std::int64_t>(pieces.size() - i) - 1};  // a tick for each that follows
        const Tick wanted = last ? when.end : stretch.at(gone);
        const Tick end = std::max(device + Ticks{1}, std::min(wanted, when.end - needed));
        const Displacement covers = piece.covered() + left;
        Piece solution = solved(piece, covers, end - device);
        left = covers - solution.covered();
        if (last && left != Displacement{} && solution.ticks.value > 1) {
            solution.ticks.value -= 1;
            fits = fits && result.push_back(solution);
            solution = tick_of(covers - solution.covered());
        }
        fits = fits && result.push_back(solution);
        device = end;
    }
    if (fits) { pieces = result; }
    return fits;
}

template bool retime(StaticVector<Piece, kMaxBodyPieces + 1>&, const Retiming&);
template bool retime(StaticVector<Piece, kMaxTailPieces + 1>&, const Retiming&);

}  // namespace lockstep
