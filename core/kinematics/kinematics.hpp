// Where the motors are when the axes are somewhere, and the other way round. The only place that knows which motors
// move an axis. The places of motors are those of their slides: without the play of their backlash.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/indices.hpp"
#include "core/kinematics/motors.hpp"
#include "core/kinematics/places.hpp"

namespace lockstep {

/// A motor that is not where the other motors of its axes place it.
struct MotorAstray {
    MotorIndex motor;
    double off_mm = 0;  // of the motor's way
};

class Kinematics {
public:
    /// `machine` as in motors_of.
    explicit Kinematics(const MachineConfig& machine);

    /// With the boards, which move nothing.
    const std::vector<MotorConfig>& motors() const { return motors_; }
    std::span<const MotorConfig> moving_motors() const { return std::span(motors_).first(map_.motors()); }
    std::size_t axes() const { return map_.axes(); }
    /// Whether each axis has one motor, with the axis's number, limits and steps, and no motor has backlash. Boards
    /// have the numbers after the motors.
    bool is_direct() const { return is_direct_; }

    /// Where the motors rest while the axes rest on whole steps: each within half a step of its place.
    MotorCounts motors_at(const AxisCounts& axes) const;
    /// The place of the axes that is nearest to the motors' places, in whole steps: one whose motors_at() they are, if
    /// there is one.
    AxisCounts axes_at(const MotorCounts& motors) const;
    /// How far axes_at() may be from the place at which the machine came to rest, because the motors rest on whole
    /// steps, in steps of the axis.
    std::int64_t rest_steps(AxisIndex axis) const { return rest_steps_[axis]; }
    /// The place of an axis in steps, exactly where the motors are.
    double axis_steps(AxisIndex axis, std::span<const Position> motors) const;
    /// mm of an axis that a motor moves alone, for each step of the motor.
    double axis_mm(AxisIndex axis, MotorIndex motor) const {
        return 1 / (map_.shares().factor(motor, axis) * axis_steps_per_mm_[axis]);
    }
    /// The speed of an axis, in its steps, where the motors are; `speeds` of the motors are in steps of the same time.
    double axis_speed(AxisIndex axis, std::span<const Position> motors, std::span<const double> speeds) const;
    /// How far an axis is moved at most if each motor moves by one step, in mm.
    double step_mm(AxisIndex axis) const { return steps_mm_[axis]; }
    /// A motor that is not where the axes' place puts it; nullopt if there is none. Motors of one axis differ after an
    /// emergency stop or a fault, and before the axis is homed. No path begins there.
    std::optional<MotorAstray> astray(const MotorCounts& motors) const;

    /// The motors that move when one of these axes moves.
    MotorSet motors_of_axes(AxisSet axes) const;
    AxisSet axes_of_motor(MotorIndex motor) const;
    /// Their names.
    std::vector<std::string> names_of_axes(AxisSet axes) const;
    /// Whether a motor corrects the errors of its screw, so that its place differs from its slide's.
    bool corrects_screw(MotorIndex motor) const { return map_.screw(motor) != nullptr; }
    /// Where a motor rests while one axis is elsewhere than the others place it: `axes` with this axis at `place`.
    std::int64_t motor_at(MotorIndex motor, AxisCounts axes, AxisIndex axis, std::int64_t place) const {
        axes[axis] = place;
        return motors_at(axes)[motor];
    }
    /// The only motor of an axis, if it moves no other axis and has the axis's steps, or corrects its screw; otherwise
    /// nullopt, also if it has backlash.
    const std::optional<MotorIndex>& own_motor(AxisIndex axis) const { return own_motors_[axis]; }
    /// Says why an axis without a motor of its own does not move by itself.
    std::string needs_frames(AxisIndex axis) const;
    /// Whether messages to people name a motor as an axis: it is the axis's own and has its name.
    bool is_named_as_axis(MotorIndex motor) const;
    /// How messages to people name a motor: `axis Y`, otherwise `motor Y2`, or `board IO`.
    std::string label(MotorIndex motor) const;

private:
    std::optional<MotorIndex> find_own_motor(AxisIndex axis) const;
    bool moves_alone(AxisIndex axis) const;
    bool rests_on_its_steps(AxisIndex axis) const;
    std::int64_t find_rest_steps(AxisIndex axis) const;
    std::int64_t place_of_all(AxisIndex axis, std::int64_t mean, const MotorCounts& motors) const;
    double step_mm_of(AxisIndex axis, const MachineConfig& machine) const;

    std::vector<MotorConfig> motors_;  // the moving ones, and behind them the boards
    std::vector<std::string> axis_names_;
    std::vector<std::optional<MotorIndex>> own_motors_;  // of each axis
    std::vector<double> steps_mm_;                       // of each axis
    std::vector<double> axis_steps_per_mm_;
    std::vector<std::int64_t> rest_steps_;  // of each axis
    MotorMap map_;                          // steps by steps
    LinearMap inverse_;                     // the joints by the motors, in steps
    bool is_direct_ = false;
};

}  // namespace lockstep
