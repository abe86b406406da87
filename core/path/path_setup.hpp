// The properties of a machine that the path planner needs.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/motion/frame_limits.hpp"
#include "core/path/axis_vector.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {

struct PathSetup {
    std::vector<AxisLimits> limits;            // of frames: frame_limits_of, as planned_limits
    std::vector<double> steps_per_mm;          // or per degree
    Ticks frame_ticks;                         // a frame's length: pieces end at the edges of frames
    std::size_t body_pieces = kMaxBodyPieces;  // for which a frame has room, for each axis

    std::size_t axes() const { return limits.size(); }
    AxisVector to_steps(std::span<const double> mm) const {
        AxisVector steps;
        for (std::size_t i = 0; i < axes(); ++i) { steps.append(mm[i] * steps_per_mm[i]); }
        return steps;
    }
    /// Moves a place beyond the travel, which rounds to its last step, to this step.
    AxisVector within_travel(AxisVector at) const {
        for (std::size_t i = 0; i < axes(); ++i) {
            at[i] =
                std::clamp(at[i], static_cast<double>(limits[i].min_steps), static_cast<double>(limits[i].max_steps));
        }
        return at;
    }
};

/// An axis that would reach its start velocity within a few ticks accelerates less. Otherwise a rounding to whole ticks
/// could change its speed by more than the start velocity, and no motion from rest would keep the limits. Its speed
/// leaves room for rounding below the greatest speed that a device can execute, and two ticks of acceleration fit into
/// this room.
inline AxisLimits planned_limits(AxisLimits axis) {
    constexpr double kTicks = 8;
    axis.max_velocity = std::min(axis.max_velocity, kMaxPlannedStepsPerTick);
    axis.start_velocity = std::min(axis.start_velocity, kMaxPlannedStepsPerTick);
    const double most = std::min(axis.start_velocity / kTicks, (kMaxStepsPerTick - axis.max_velocity) / 2);
    axis.max_acceleration = std::min(axis.max_acceleration, most);
    axis.max_deceleration = std::min(axis.max_deceleration, most);
    return axis;
}

inline PathSetup path_setup_of(const MachineConfig& machine) {
    PathSetup setup{.limits = frame_limits_of(machine),
                    .steps_per_mm = {},
                    .frame_ticks = machine.frame_ticks(),
                    .body_pieces = static_cast<std::size_t>(body_pieces(machine.timing))};
    for (AxisLimits& axis : setup.limits) { axis = planned_limits(axis); }
    for (const AxisConfig& axis : machine.axes) { setup.steps_per_mm.push_back(axis.steps_per_mm); }
    return setup;
}

/// The shares of one step of deviation. Whole pulses take kPulseShare, pieces of constant acceleration kFitShare, and
/// rounding kRoundingShare. The rest is for joining moves.
inline constexpr double kPulseShare = 0.5;      // steps
inline constexpr double kFitShare = 0.03;       // steps
inline constexpr double kRoundingShare = 0.01;  // steps

inline constexpr double kNothing = 1e-12;  // steps per mm: an axis with less does not move

/// The smaller of its acceleration and deceleration, steps per tick^2.
inline double weaker(const AxisLimits& axis) { return std::min(axis.max_acceleration, axis.max_deceleration); }

}  // namespace lockstep
