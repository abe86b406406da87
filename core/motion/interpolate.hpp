// The DDA: turns a path's motion into each axis's add-only pieces, exact at every joint and to the last step.
//
// All axes follow one variable, the lead axis's place s(t). An axis's place is its exact share of s. A piece's
// acceleration is the same share of the path's, and its velocity is solved so that the piece ends on the path. The
// rounding error (less than one unit of 2^-64 step per tick) is carried into the next piece, so errors do not add up.
#pragma once

#include <span>
#include <vector>

#include "core/motion/path.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

/// Divides a path into stretches of whole ticks with one acceleration each, and makes the pieces of all axes for them.
class PieceSource {
public:
    /// Follows `path` over the ticks [begin, end). `at` is the position of each axis and is updated.
    PieceSource(const Path& path, Ticks begin, Ticks end, std::span<Position> at);

    /// Writes the next stretch into `pieces`, one piece per axis, in the axes' order. Returns false at the end.
    bool next(std::span<Piece> pieces);

private:
    Ticks stretch_end(const PathMove*& move, double& acceleration) const;

    const Path& path_;
    Ticks now_;
    Ticks end_;
    std::span<Position> at_;
};

/// The position from which an axis at rest starts a path. A backward start is one unit lower (see rest_position).
Position start_of(const Path& path, std::size_t axis, std::int64_t count);

/// Solves a piece: `ticks` long, ending at `to`, with the given acceleration in steps per tick^2.
Piece solve_piece(Position from, Position to, Ticks ticks, double acceleration);

/// The pieces of a single axis's whole profile, starting at `from`, in `direction` (+1 or -1). The axis is the lead.
std::vector<Piece> pieces_of(const Profile& profile, Position from, int direction);

}  // namespace lockstep
