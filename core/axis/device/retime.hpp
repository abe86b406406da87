// Converts motion planned in machine time for a device with a clock that runs a little faster or slower.
//
// A body or tail keeps the places of its two ends, at given ticks of the device's clock. Between them the rate of the
// device's clock against machine time changes evenly (core/axis/device/frame_pace.hpp). Each piece ends at the tick
// nearest to its mapped end, at the place that the motion has reached by that tick. So even short pieces keep their
// speeds, and each step is made within a tick of the motion. The velocity is solved for the place. The rest that
// rounding leaves (less than a tick's worth of the smallest velocity) goes into the next piece. The last tick of the
// last piece becomes a separate piece that ends on the exact place. So neither time nor place accumulates an error, and
// the next frame, or the axis's rest, joins bit for bit.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

/// The time of a body or a tail on the device's clock.
struct Retiming {
    Tick start;
    Tick end;         // at least one tick per piece after `start`
    double bend = 0;  // the rate at its end is to that at its start as 1 + bend to 1 - bend

    /// The greatest difference of a tick from the same tick at a constant rate.
    Ticks bow() const;
};

/// Replaces the pieces by those for the device, at most one more. Returns false and changes nothing if they do not fit.
template <std::size_t Capacity>
[[nodiscard]] bool retime(StaticVector<Piece, Capacity>& pieces, const Retiming& when);

/// Moves changes of outputs in a stretch of `machine` ticks to the same places of the motion by the device's clock.
void retime(OutputChange* changes, std::size_t count, Ticks machine, const Retiming& when);

extern template bool retime(StaticVector<Piece, kMaxBodyPieces + 1>&, const Retiming&);
extern template bool retime(StaticVector<Piece, kMaxTailPieces + 1>&, const Retiming&);

}  // namespace lockstep
