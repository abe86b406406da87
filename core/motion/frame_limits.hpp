// What frames may ask of an axis: its limits, less what its device's clock may add to them.
//
// Where boards have clocks of their own (TimeSource::Network) frames are planned in machine time and made in the
// device's, and there the axis's limits hold at every step. The two rates differ by ClockEstimator::kMaxRate at most,
// and while a correction lasts by MachineTime::kMaxSlew more: 700 ppm in all. A correction that begins or ends is a
// change of speed, made with kCorrectionShare of the axis's acceleration (core/axis/device/frame_pace.hpp). So the
// planner keeps the reserves below, and an axis refuses frames that do not: plan, frame check, steps and their analysis
// go by the same limits. Everywhere else, and in an axis's own moves, which keep the device's ticks, the reserves are
// 0.
#pragma once

#include <vector>

#include "core/machine.hpp"

namespace lockstep::clock_reserve {

inline constexpr double kSpeed = 1e-3;            // of the greatest speed; 700 ppm, and what rounding makes
inline constexpr double kAcceleration = 1e-2;     // of the accelerations and the start velocity; with:
inline constexpr double kCorrectionShare = 8e-3;  // of the acceleration, for corrections; 700 ppm twice is the rest

}  // namespace lockstep::clock_reserve

namespace lockstep {

AxisLimits frame_limits_of(const MachineConfig& machine, std::size_t axis);
/// Of all axes, by their places in the configuration.
std::vector<AxisLimits> frame_limits_of(const MachineConfig& machine);

}  // namespace lockstep
