// The properties of a machine that the path planner needs.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "core/kinematics/motors.hpp"
#include "core/motion/frame_limits.hpp"
#include "core/path/axis_vector.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {

/// The backlash of a motor.
struct MotorBacklash {
    Backlash backlash;
    double steps_per_mm = 0;    // of the motor
    double steps_per_tick = 0;  // the speed of the motor while it takes up the play
};

/// Geometry is in steps of the axes; speeds are limited and pieces fitted in rows. If each axis is moved by a motor of
/// its own, with the axis's steps, the rows are the axes. Otherwise they are the motors, and behind them the axes.
struct PathSetup {
    std::vector<AxisLimits> limits;            // of the rows in frames: frame_limits_of, with reserves for planning
    std::vector<double> steps_per_mm;          // of the axes, or per degree
    Ticks frame_ticks;                         // a frame's length: pieces end at the edges of frames
    std::size_t body_pieces = kMaxBodyPieces;  // for which a frame has room, for each motor
    std::size_t tail_pieces = kMaxTailPieces;
    bool has_outputs = false;   // frames list the moves that begin in their tails
    bool tells_speeds = false;  // frames list the speeds along the path
    std::size_t boards = 0;     // behind the motors in frames; they rest
    MotorMap motor_map;         // steps of the motors by those of the axes; empty: each axis is a motor
    /// Steps of each axis: if all axes deviate by so much, no motor deviates by more than a step. Empty: 1.
    std::vector<double> motor_step;
    std::vector<MotorBacklash> backlashes;  // of the motors; empty: none has any

    std::size_t axes() const { return steps_per_mm.size(); }
    std::size_t motors() const { return has_map() ? motor_map.motors() : limits.size(); }
    std::size_t rows() const { return limits.size(); }
    bool has_map() const { return motor_map.axes() > 0; }
    std::size_t first_axis_row() const { return motor_map.motors(); }
    const AxisLimits& limits_of_axis(AxisIndex axis) const { return limits[first_axis_row() + axis]; }
    double step_of_motors(AxisIndex axis) const { return has_map() ? motor_step[axis] : 1; }
    /// The motors are moved by `map`. `limits` are those of the motors so far; `axes` are appended.
    void use_map(const MotorMap& map, std::span<const AxisLimits> axes);
    PlaceVector to_steps(std::span<const double> mm) const {
        PlaceVector steps;
        for (std::size_t i = 0; i < axes(); ++i) { steps.append(mm[i] * steps_per_mm[i]); }
        return steps;
    }
    /// Moves a place beyond the travel, which rounds to its last step, to this step.
    PlaceVector within_travel(PlaceVector at) const {
        for (const AxisIndex i : axis_indices(axes())) {
            const AxisLimits& axis = limits_of_axis(i);
            at[i] = std::clamp(at[i], static_cast<double>(axis.min_steps), static_cast<double>(axis.max_steps));
        }
        return at;
    }
};

inline void PathSetup::use_map(const MotorMap& map, std::span<const AxisLimits> axes) {
    motor_map = map;
    limits.insert(limits.end(), axes.begin(), axes.end());
    motor_step.assign(map.axes(), std::numeric_limits<double>::infinity());
    for (const MotorIndex m : motor_indices(map.motors())) {
        double sum = 0;
        for (const double share : map.shares().row(m)) { sum += std::abs(share); }
        sum *= 1 + map.screw_share(m);
        for (std::size_t i = 0; i < map.axes(); ++i) {
            if (map.shares().factor(m, i) != 0) { motor_step[i] = std::min(motor_step[i], 1 / sum); }
        }
    }
}

/// A row that would reach its start velocity within a few ticks accelerates less. Otherwise a rounding to whole ticks
/// could change its speed by more than the start velocity, and no motion from rest would keep the limits.
inline AxisLimits planned_limits(AxisLimits row) {
    constexpr double kTicks = 8;
    row.max_acceleration = std::min(row.max_acceleration, row.start_velocity / kTicks);
    row.max_deceleration = std::min(row.max_deceleration, row.start_velocity / kTicks);
    return row;
}

/// The speed of a motor also leaves room for rounding below the greatest speed that a device can execute, and two ticks
/// of acceleration fit into this room. No device makes the steps of an axis that has motors with other ones.
inline AxisLimits planned_motor_limits(AxisLimits motor) {
    motor.max_velocity = std::min(motor.max_velocity, kMaxPlannedStepsPerTick);
    motor.start_velocity = std::min(motor.start_velocity, kMaxPlannedStepsPerTick);
    motor = planned_limits(motor);
    const double most = (kMaxStepsPerTick - motor.max_velocity) / 2;
    motor.max_acceleration = std::min(motor.max_acceleration, most);
    motor.max_deceleration = std::min(motor.max_deceleration, most);
    return motor;
}

inline PathSetup path_setup_of(const MachineConfig& machine) {
    PathSetup setup{.limits = frame_limits_of(machine),
                    .steps_per_mm = {},
                    .frame_ticks = machine.frame_ticks(),
                    .body_pieces = static_cast<std::size_t>(body_pieces(machine.timing)),
                    .tail_pieces = static_cast<std::size_t>(tail_pieces(machine.timing)),
                    .boards = machine.boards.size()};
    setup.limits.resize(moving_motor_count(machine));
    const bool takes_up = has_backlash(machine);
    if (const MotorMap map = step_map_of(machine); takes_up || !map.is_identity()) {
        setup.use_map(map, axis_frame_limits_of(machine));
    }
    if (takes_up) {
        for (const MotorConfig& motor : moving_motors_of(machine)) {
            const double steps_per_s = motor.backlash.speed_mm_s * motor.steps_per_mm;
            setup.backlashes.push_back(
                {motor.backlash, motor.steps_per_mm, steps_per_s * static_cast<double>(machine.tick_ns) * 1e-9});
        }
    }
    for (std::size_t i = 0; i < setup.rows(); ++i) {
        AxisLimits& row = setup.limits[i];
        row = i < setup.motors() ? planned_motor_limits(row) : planned_limits(row);
    }
    for (const AxisConfig& axis : machine.axes) { setup.steps_per_mm.push_back(axis.steps_per_mm); }
    setup.has_outputs = !machine.outputs.empty();
    setup.tells_speeds = std::ranges::any_of(
        machine.outputs, [](const OutputConfig& output) { return output.pwm && output.pwm->follows_speed; });
    return setup;
}

/// The shares of one step of deviation. Whole pulses take kPulseShare, pieces of constant acceleration kFitShare,
/// rounding kRoundingShare, and the pieces of a map that is not linear kMapShare. The rest is for joining moves.
inline constexpr double kPulseShare = 0.5;      // steps
inline constexpr double kFitShare = 0.03;       // steps
inline constexpr double kRoundingShare = 0.01;  // steps
inline constexpr double kMapShare = 0.02;       // steps

inline constexpr double kNothing = 1e-12;  // steps per mm: a row with less does not move

/// The smaller of its acceleration and deceleration, steps per tick^2.
inline double weaker(const AxisLimits& axis) { return std::min(axis.max_acceleration, axis.max_deceleration); }

}  // namespace lockstep
