// The DDA: turns a path's motion into each axis's add-only pieces, exact at every joint and to the last step.
//
// All axes follow one variable, the lead axis's place s(t). An axis's place is its exact share of s; a piece's
// acceleration is the share of the path's, and its velocity is solved so that the piece ends where the path then is.
// What that rounds off (less than one unit of 2^-64 step per tick) is carried into the next piece, so nothing adds up.
#pragma once

#include <span>
#include <vector>

#include "core/motion/path.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

/// A stretch of whole ticks in which the path has one acceleration, and the shares of all axes in it.
class PieceSource {
public:
    /// Follows `path` over the ticks [begin, end); `at` is where each axis is, and is moved along.
    PieceSource(const Path& path, Ticks begin, Ticks end, std::span<Position> at);

    /// The next stretch: one piece per axis into `pieces`, in the axes' order. False at the end.
    bool next(std::span<Piece> pieces);

private:
    Ticks stretch_end(const PathMove*& move, double& acceleration) const;

    const Path& path_;
    Ticks now_;
    Ticks end_;
    std::span<Position> at_;
};

/// The place an axis starts a path from at rest: a backward start is one unit lower (see rest_position).
Position start_of(const Path& path, std::size_t axis, std::int64_t count);

/// Solves a piece: `ticks` long, ending at `to`, with the given acceleration in steps per tick^2.
Piece solve_piece(Position from, Position to, Ticks ticks, double acceleration);

/// A single axis's whole profile from `from`, its lead axis being the axis itself, in `direction` (+1 or -1).
std::vector<Piece> pieces_of(const Profile& profile, Position from, int direction);

}  // namespace lockstep
