// Single straight moves: their limits along the path, a plan from rest to rest, and the way to rest of a path that
// Lai's planner has made of them (core/coordinator/path/lai_path.hpp). core/path plans everything else.
#pragma once

#include <span>

#include "core/machine.hpp"
#include "core/motion/path.hpp"

namespace lockstep {

/// The shortest duration of a move. It bounds the number of pieces of a machine's frames.
Ticks least_move(const MachineConfig& machine);

/// A move from one place to another with its limits along the path, before any profile. `feed_mm_per_tick`: nullopt
/// means as fast as the axes allow. The move's lead is 0 if nothing moves.
PathMove make_move(const AxisCounts& from, const AxisCounts& to, std::span<const AxisLimits> limits,
                   std::span<const double> steps_per_mm, std::optional<double> feed_mm_per_tick);

/// Plans the move from rest to rest, or its part behind `along`, in whole ticks, at speeds at which the whole move
/// lasts at least `least`. A dwell lasts its time.
PathMove plan_alone(PathMove move, Displacement along, Ticks least);

/// Replaces `rest` by the way to rest from time t on: the same moves, braked as hard as their limits allow. During the
/// path's last deceleration it is the remainder of the path. If the end of a move is too near, braking begins behind
/// it. Time 0 of `rest` is t. `rest` is empty if the path is at rest at t. It keeps its memory.
void brake_from(const Path& path, Subticks t, std::span<const AxisLimits> limits, Path& rest);

}  // namespace lockstep
