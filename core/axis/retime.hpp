// Motion planned in machine time, for a device whose own clock runs a little faster or slower.
//
// Every piece's end keeps its place and gets a tick of the device's clock, in proportion: what is to be corrected is
// spread over the whole stretch, since a short piece that had to make up for it all would break the axis's limits.
// Between, the velocity is solved again. What rounding leaves of a piece (less than a tick's worth of the smallest
// velocity) goes into the next, and the last piece gives up its last tick to a piece of its own that ends on the very
// place. So nothing accumulates, neither in time nor in space, and the next frame, or the axis's rest, joins bit for
// bit.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

/// The stretch of a body or a tail on the device's clock.
struct Retiming {
    Tick start;
    Tick end;  // at least as many ticks later as there are pieces
};

/// The device's pieces: at most one more than there are. Nothing, where that is more than fit.
template <std::size_t Capacity>
[[nodiscard]] bool retime(StaticVector<Piece, Capacity>& pieces, const Retiming& when);

extern template bool retime(StaticVector<Piece, kMaxBodyPieces + 1>&, const Retiming&);
extern template bool retime(StaticVector<Piece, kMaxTailPieces + 1>&, const Retiming&);

}  // namespace lockstep
