// The state of an axis by those of its motors.
#pragma once

#include <optional>
#include <span>

#include "core/kinematics/kinematics.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// The position of the motor's slide in steps of the motor: the motor's position minus its play.
inline Position slide_of(const AxisState& motor) { return motor.position - Displacement::steps(motor.play_steps); }

/// The motors whose places an axis's place needs: its own, and those that share axes with them.
MotorSet motors_needed_for(AxisIndex axis, const Kinematics& kinematics);

/// Of an axis with a motor of its own it is that motor's, with the position of the slide if the motor corrects its
/// screw. Of other axes: the position in steps of the axis, at the time of the newest state of its motors, without
/// velocity (axis_speed_of); homed, at rest, and receives its owner if all its motors do; the phase and the fault of
/// the first motor that has a fault, or of the first one; a switch that is closed at any motor that moves the axis.
/// `motors` has all motors of the machine, in order. nullopt if a motor that the axis needs was never received.
std::optional<AxisState> axis_state_of(AxisIndex axis, const Kinematics& kinematics,
                                       std::span<const AxisState* const> motors);

/// In steps of the axis per tick.
double axis_speed_of(AxisIndex axis, const Kinematics& kinematics, std::span<const AxisState* const> motors);

}  // namespace lockstep
