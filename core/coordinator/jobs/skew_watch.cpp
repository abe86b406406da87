#include "core/coordinator/jobs/skew_watch.hpp"

#include <cmath>

#include "core/kinematics/motors.hpp"

namespace lockstep {

SkewWatch::SkewWatch(const MachineConfig& machine, const Kinematics& kinematics) {
    const std::vector<MotorConfig>& motors = kinematics.motors();
    for (std::size_t m = 0; m < motors.size(); ++m) {
        const MotorConfig& motor = motors[m];
        const AxisConfig& axis = machine.axes[motor.axis];
        if (axis.motors.size() < 2 || !motor.moves_one_axis) { continue; }
        if (motors_.empty()) { motors_.resize(motors.size()); }
        motors_[m] = {
            .axis = motor.axis, .axis_mm_per_step = kinematics.axis_mm(motor.axis, m), .most_mm = axis.max_skew_mm};
    }
}

void SkewWatch::begin(const AxisRoster& motors) {
    for (std::size_t m = 0; m < motors_.size(); ++m) {
        const auto& state = motors.state(m);
        motors_[m].was_homed = state && state->homed;
        motors_[m].count = state ? state->position.count() : 0;
        motors_[m].way_mm = 0;
    }
}

std::optional<std::size_t> SkewWatch::look(const AxisRoster& motors) {
    for (std::size_t m = 0; m < motors_.size(); ++m) {
        Motor& motor = motors_[m];
        const auto& state = motors.state(m);
        if (!motor.most_mm || !state) { continue; }
        const std::int64_t count = state->position.count();
        const bool sets_zero = state->homed && !motor.was_homed;
        if (!sets_zero) { motor.way_mm += static_cast<double>(count - motor.count) * motor.axis_mm_per_step; }
        motor.was_homed = state->homed;
        motor.count = count;
    }
    for (std::size_t m = 1; m < motors_.size(); ++m) {
        const Motor& motor = motors_[m];
        const Motor& before = motors_[m - 1];
        if (!motor.most_mm || !before.most_mm || motor.axis != before.axis) { continue; }
        if (std::abs(motor.way_mm - before.way_mm) > *motor.most_mm) { return m; }
    }
    return std::nullopt;
}

}  // namespace lockstep
