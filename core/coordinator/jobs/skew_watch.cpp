#include "core/coordinator/jobs/skew_watch.hpp"

#include <algorithm>
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
        motors_[m] = {.axis = motor.axis,
                      .axis_mm_per_step = kinematics.axis_mm(motor.axis, m),
                      .most_mm = axis.max_skew_mm,
                      .switch_at = to_steps(motor, motor.homing.switch_position_mm)};
    }
}

void SkewWatch::begin(const AxisRoster& motors) {
    for (std::size_t m = 0; m < motors_.size(); ++m) {
        const auto& state = motors.state(m);
        motors_[m].was_homed = state && state->homed;
        motors_[m].count = state ? state->position.count() : 0;
        motors_[m].is_known = motors_[m].was_homed;
        motors_[m].begin_mm = static_cast<double>(motors_[m].count) * motors_[m].axis_mm_per_step;
        motors_[m].stamp = state ? state->stamp : 0;
        motors_[m].way_mm = motors_[m].before_mm = 0;
    }
}

std::optional<std::size_t> SkewWatch::look(const AxisRoster& motors) {
    for (std::size_t m = 0; m < motors_.size(); ++m) {
        Motor& motor = motors_[m];
        const auto& state = motors.state(m);
        if (!motor.most_mm || !state || state->stamp == motor.stamp) { continue; }
        motor.stamp = state->stamp;
        motor.before_mm = motor.way_mm;
        const std::int64_t count = state->position.count();
        const bool sets_zero = state->homed && !motor.was_homed;
        const std::int64_t from = sets_zero ? motor.switch_at : motor.count;
        motor.way_mm += static_cast<double>(count - from) * motor.axis_mm_per_step;
        motor.was_homed = state->homed;
        motor.count = count;
    }
    for (std::size_t m = 1; m < motors_.size(); ++m) {
        for (std::size_t other = 0; other < m; ++other) {
            if (are_apart(motors_[m], motors_[other])) { return m; }
        }
    }
    return std::nullopt;
}

bool SkewWatch::are_apart(const Motor& one, const Motor& other) {
    if (!one.most_mm || !other.most_mm || one.axis != other.axis) { return false; }
    const double begin = one.is_known && other.is_known ? one.begin_mm - other.begin_mm : 0;
    const double steps = std::abs(one.axis_mm_per_step) + std::abs(other.axis_mm_per_step);  // they do not move at once
    const double most = std::max(*one.most_mm, std::abs(begin) + steps);
    return std::abs(begin + one.way_mm - other.way_mm) > most &&
           std::abs(begin + one.before_mm - other.before_mm) > most;
}

}  // namespace lockstep
