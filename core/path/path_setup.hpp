// What the path planner must know of a machine.
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
    std::vector<AxisLimits> limits;            // of frames: frame_limits_of
    std::vector<double> steps_per_mm;          // or per degree
    Ticks frame_ticks;                         // a frame's length: pieces end at the edges of frames
    std::size_t body_pieces = kMaxBodyPieces;  // that a frame has room for, for each axis

    std::size_t axes() const { return limits.size(); }
    AxisVector to_steps(std::span<const double> mm) const {
        AxisVector steps;
        for (std::size_t i = 0; i < axes(); ++i) { steps.append(mm[i] * steps_per_mm[i]); }
        return steps;
    }
    /// A place that is rounded to the last step of the travel is moved to this step.
    AxisVector within_travel(AxisVector at) const {
        for (std::size_t i = 0; i < axes(); ++i) {
            at[i] =
                std::clamp(at[i], static_cast<double>(limits[i].min_steps), static_cast<double>(limits[i].max_steps));
        }
        return at;
    }
};

inline PathSetup path_setup_of(const MachineConfig& machine) {
    PathSetup setup{.limits = frame_limits_of(machine),
                    .steps_per_mm = {},
                    .frame_ticks = machine.frame_ticks(),
                    .body_pieces = static_cast<std::size_t>(body_pieces(machine.timing))};
    for (const AxisConfig& axis : machine.axes) { setup.steps_per_mm.push_back(axis.steps_per_mm); }
    return setup;
}

/// How a programmed step of deviation is shared out. Whole pulses take a half; the pieces of constant acceleration get
/// kFitShare; the rest is for joining moves, less a little for rounding.
inline constexpr double kPulseShare = 0.5;      // steps
inline constexpr double kFitShare = 0.03;       // steps
inline constexpr double kRoundingShare = 0.01;  // steps

inline constexpr double kNothing = 1e-12;  // steps per mm: an axis that does not move

/// Of its two accelerations, steps per tick^2.
inline double weaker(const AxisLimits& axis) { return std::min(axis.max_acceleration, axis.max_deceleration); }

}  // namespace lockstep
