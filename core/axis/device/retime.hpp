// Motion planned in machine time, for a device whose own clock runs a little faster or slower.
//
// A stretch of it keeps its two ends' places, at the ticks of the device's clock that it is given. Between, the
// device's clock goes by the machine's at a rate that changes evenly (core/axis/device/frame_pace.hpp). Each piece ends
// at the tick nearest to its end, at the place that the motion has come to by then: so pieces keep their speeds,
// however short they are, and each step is made within a tick of the motion. The velocity is solved for the place. What
// rounding leaves of it (less than a tick's worth of the smallest velocity) goes into the next piece, and the last
// piece gives up its last tick to a piece of its own that ends on the very place. So nothing accumulates, neither in
// time nor in space, and the next frame, or the axis's rest, joins bit for bit.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

/// The stretch of a body or a tail on the device's clock.
struct Retiming {
    Tick start;
    Tick end;         // at least as many ticks later as there are pieces
    double bend = 0;  // the rate at its end is to that at its start as 1 + bend to 1 - bend

    /// How far it goes, at most, from a rate that does not change.
    Ticks bow() const;
};

/// The device's pieces: at most one more than there are. Nothing, where that is more than fit.
template <std::size_t Capacity>
[[nodiscard]] bool retime(StaticVector<Piece, Capacity>& pieces, const Retiming& when);

extern template bool retime(StaticVector<Piece, kMaxBodyPieces + 1>&, const Retiming&);
extern template bool retime(StaticVector<Piece, kMaxTailPieces + 1>&, const Retiming&);

}  // namespace lockstep
