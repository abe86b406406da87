// Gives every move of a path its profile: as fast as the limits, the corners and the way to rest allow.
#pragma once

#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/motion/path.hpp"

namespace lockstep {

/// What the frames can carry bounds how short moves may get and how many a stop may span.
struct PathBounds {
    Ticks least_move;             // a move lasts at least this long, so that a frame's pieces are bounded
    std::size_t stop_moves = 24;  // from any place the machine can stop within so many moves
    Ticks worth_splitting{};      // what is left of a move that lasts as long is planned again, else from its end on
};

/// The bounds for a machine's frames and tails.
PathBounds bounds_of(const MachineConfig& machine);

/// A move from one place to another with its limits along the path, before any profile. `feed_mm_per_tick` 0 means as
/// fast as the axes allow. The move's lead is 0 where nothing moves.
PathMove make_move(const AxisCounts& from, const AxisCounts& to, std::span<const AxisLimits> limits,
                   std::span<const double> steps_per_mm, double feed_mm_per_tick);

/// Plans moves that follow each other without rest. The first starts `along` its lead axis. Corners are taken at
/// the speed at which no axis jumps by more than its start velocity. A path of one move is planned in whole ticks.
Path plan_path(std::vector<PathMove> moves, Displacement along, std::span<const AxisLimits> limits,
               const PathBounds& bounds, const Overrides& overrides = {});

/// Plans a path again from time t on, with other overrides, without coming to rest: what is before stays, and place and
/// speed at t too. The moves keep their numbers. False, and nothing has changed: what lies ahead at this speed leaves
/// no way to (its corners would ask for more of the braking that is under way); a little later there is one.
bool replan_from(Path& path, Ticks t, std::span<const AxisLimits> limits, const PathBounds& bounds,
                 const Overrides& overrides);

/// The way to rest from time t on: the same moves, braked as hard as their limits allow; the remainder of the path
/// itself where it is on its last fall, and to the end of a move that is too near to brake before it. Its time 0 is t.
/// Empty where the path is at rest at t.
Path brake_from(const Path& path, Subticks t, std::span<const AxisLimits> limits);

}  // namespace lockstep
