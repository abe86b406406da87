#include "core/coordinator/homing/skew_watch.hpp"

#include <algorithm>
#include <cmath>

#include "core/kinematics/motors.hpp"

namespace lockstep {

SkewWatch::SkewWatch(const MachineConfig& machine, const Kinematics& kinematics) {
    const std::vector<MotorConfig>& motors = kinematics.motors();
    for (const MotorIndex m : motor_indices(motors.size())) {
        const MotorConfig& motor = motors[m];
        if (!motor.moves_one_axis) { continue; }
        const AxisConfig& axis = machine.axes[*motor.axis];
        if (axis.motors.size() < 2) { continue; }
        if (motors_.empty()) { motors_.resize(motors.size()); }
        motors_[m] = {.axis = *motor.axis,
                      .axis_mm_per_step = kinematics.axis_mm(*motor.axis, m),
                      .steps_per_slot = motor.max_velocity_mm_s * motor.steps_per_mm *
                                        static_cast<double>(machine.timing.slot_us) * 1e-6,
                      .most_mm = axis.max_skew_mm,
                      .travel_mm = axis.position_max_mm - axis.position_min_mm,
                      .switch_at = to_steps(motor, motor.homing.switch_position_mm)};
    }
}

void SkewWatch::begin(const AxisRoster& motors) {
    for (const MotorIndex m : motor_indices(motors_.size())) {
        Motor& motor = motors_[m];
        const auto& state = motors.state(m);
        motor.begin_mm.reset();
        if (state && state->homed) {
            motor.begin_mm = static_cast<double>(state->position.count()) * motor.axis_mm_per_step;
        }
        motor.newest.reset();
        motor.last.reset();
        motor.way_mm = 0;
        motor.passed = {};
    }
}

std::optional<MotorIndex> SkewWatch::look(const AxisRoster& motors) {
    for (const MotorIndex m : motor_indices(motors_.size())) {
        Motor& motor = motors_[m];
        const auto& state = motors.state(m);
        if (!motor.most_mm || !state || (motor.newest && state->stamp == motor.newest->slot)) { continue; }
        const Reading reading{state->homed, state->position.count(), state->stamp};
        if (motor.newest && agrees(*motor.newest, reading, motor)) { take(*motor.newest, motor); }
        motor.newest = reading;
    }
    for (const MotorIndex m : motor_indices(motors_.size())) {
        for (const MotorIndex other : motor_indices(m)) {
            if (are_apart(motors_[m], motors_[other])) { return m; }
        }
    }
    return std::nullopt;
}

void SkewWatch::take(const Reading& reading, Motor& motor) {
    if (motor.last) {
        const bool sets_zero = reading.is_homed && !motor.last->is_homed;
        const std::int64_t from = sets_zero ? motor.switch_at : motor.last->count;
        motor.way_mm += static_cast<double>(reading.count - from) * motor.axis_mm_per_step;
    }
    motor.last = reading;
    motor.passed[static_cast<std::size_t>(reading.slot) % motor.passed.size()] = {reading.slot, motor.way_mm};
}

bool SkewWatch::agrees(const Reading& one, const Reading& next, const Motor& motor) {
    constexpr double kBetweenSteps = 2;
    const auto slots = static_cast<double>(std::abs(next.slot - one.slot));
    const auto steps = static_cast<double>(std::abs(next.count - one.count));
    return next.is_homed == one.is_homed && steps <= motor.steps_per_slot * slots + kBetweenSteps;
}

bool SkewWatch::are_apart(const Motor& one, const Motor& other) {
    if (!one.most_mm || !other.most_mm || one.axis != other.axis) { return false; }
    double begin = one.begin_mm && other.begin_mm ? *one.begin_mm - *other.begin_mm : 0;
    if (std::abs(begin) > one.travel_mm) { begin = 0; }                                      // a damaged state
    const double steps = std::abs(one.axis_mm_per_step) + std::abs(other.axis_mm_per_step);  // they do not move at once
    const double most = std::max(*one.most_mm, std::abs(begin) + steps);
    struct Compared {
        Slot slot = 0;
        bool is_apart = false;
    };
    std::array<Compared, 2> newest{};  // the newest slot of which both have a way, and the one before it
    for (std::size_t k = 0; k < one.passed.size(); ++k) {
        const Passed& a = one.passed[k];
        const Passed& b = other.passed[k];
        if (!a.slot || a.slot != b.slot) { continue; }
        const Compared at{*a.slot, std::abs(begin + a.way_mm - b.way_mm) > most};
        if (at.slot > newest[0].slot) {
            newest = {at, newest[0]};
        } else if (at.slot > newest[1].slot) {
            newest[1] = at;
        }
    }
    return newest[0].is_apart && newest[1].is_apart;
}

}  // namespace lockstep
