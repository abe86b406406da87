// Straight moves one by one: their limits along the path, a plan from rest to rest, and the way to rest of a path that
// Lai's planner has made of them (core/coordinator/path/lai_path.hpp). All else is planned by core/path.
#pragma once

#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/motion/path.hpp"

namespace lockstep {

/// A move lasts at least this long, so that the pieces of a machine's frames are bounded.
Ticks least_move(const MachineConfig& machine);

/// A move from one place to another with its limits along the path, before any profile. `feed_mm_per_tick` 0 means as
/// fast as the axes allow. The move's lead is 0 where nothing moves.
PathMove make_move(const AxisCounts& from, const AxisCounts& to, std::span<const AxisLimits> limits,
                   std::span<const double> steps_per_mm, double feed_mm_per_tick);

/// The move from rest to rest, or what is left of it behind `along`, in whole ticks and no sooner than `least`; a dwell
/// lasts its time.
PathMove plan_alone(PathMove move, Displacement along, Ticks least);

/// The way to rest from time t on: the same moves, braked as hard as their limits allow; the remainder of the path
/// itself where it is on its last fall, and to the end of a move that is too near to brake before it. Its time 0 is t.
/// Empty where the path is at rest at t.
Path brake_from(const Path& path, Subticks t, std::span<const AxisLimits> limits);

}  // namespace lockstep
