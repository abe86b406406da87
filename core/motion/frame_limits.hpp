// The limits of a motor in frames: its own limits minus reserves for its device's clock.
//
// If a board or a device has its own clock (estimates_clock), frames are planned in machine time and
// executed in device time, in which the axis's limits hold at every step. The two rates differ by at most
// ClockEstimator::kMaxRate, and during a correction by MachineTime::kMaxSlew more: 700 ppm in all. The speed changes
// when a correction begins or ends, with kCorrectionShare of the axis's acceleration (core/axis/device/frame_pace.hpp).
// So the planner keeps the reserves below, and an axis refuses frames that do not. Plan, frame check, steps and their
// analysis use the same limits. If all clocks are the same, and in an axis's own moves, which are timed in device
// ticks, the reserves are 0.
#pragma once

#include <span>
#include <vector>

#include "core/kinematics/motors.hpp"
#include "core/kinematics/places.hpp"

namespace lockstep::clock_reserve {

inline constexpr double kSpeed = 1e-3;            // of the greatest speed: 700 ppm, and rounding
inline constexpr double kAcceleration = 1e-2;     // of the accelerations and the start velocity; includes
inline constexpr double kCorrectionShare = 8e-3;  // of the acceleration, for corrections; the rest covers twice 700 ppm

}  // namespace lockstep::clock_reserve

namespace lockstep {

AxisLimits frame_limits_of(const MachineConfig& machine, MotorIndex motor);
/// The same limits of all motors, in the order of motors_of.
std::vector<AxisLimits> frame_limits_of(const MachineConfig& machine);
/// The limits of the axes themselves by the machine's file, with reserves if a motor estimates a clock.
std::vector<AxisLimits> axis_frame_limits_of(const MachineConfig& machine);
/// The nearest place that each axis may have, by axis_frame_limits_of.
AxisCounts within_travel(AxisCounts at, std::span<const AxisLimits> axes);

}  // namespace lockstep
