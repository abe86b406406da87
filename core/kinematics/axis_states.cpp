#include "core/kinematics/axis_states.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/kinematics/kinematics.hpp"

namespace lockstep {
namespace {

constexpr Slot kMostSlotsApart = 2;  // a state that is older shows where the motor was

/// The newest of the motors' states.
const AxisState* newest_of(MotorSet needed, std::span<const AxisState* const> motors) {
    const AxisState* newest = nullptr;
    for (const MotorIndex m : needed) {
        if (motors[m] == nullptr) { continue; }
        if (newest == nullptr || newest->tick < motors[m]->tick) { newest = motors[m]; }
    }
    return newest;
}

/// Where the motor's slide is at the time of the newest state. Processes read their devices at different times of a
/// slot.
Position place_at(const AxisState& newest, const AxisState& motor) {
    if (newest.stamp - motor.stamp > kMostSlotsApart) { return slide_of(motor); }
    return slide_of(motor) + Displacement{Int128{motor.velocity.raw} * (newest.tick - motor.tick).value};
}

Switches any_of(const Switches& a, const Switches& b) {
    return {a.limit_min || b.limit_min, a.limit_max || b.limit_max, a.home || b.home};
}

/// Of an axis whose motor has its steps. If the motor corrects its screw, the place is the slide's.
AxisState state_by_own(AxisIndex axis, MotorIndex own, const Kinematics& kinematics,
                       std::span<const AxisState* const> motors) {
    AxisState state = *motors[own];
    if (!kinematics.corrects_screw(own)) { return state; }
    MotorCounts counts;
    std::vector<Position> places(motors.size());
    for (const MotorIndex m : motor_indices(motors.size())) {
        counts.steps.append(m == own ? state.position.count() : 0);
    }
    places[own] = state.position;
    const bool is_whole = rests_on_whole_step(state.position);
    state.position = is_whole ? Position::steps(kinematics.axes_at(counts)[axis])
                              : Position{static_cast<Int128>(kinematics.axis_steps(axis, places) * 0x1p64)};
    state.velocity = {};
    return state;
}

}  // namespace

MotorSet motors_needed_for(AxisIndex axis, const Kinematics& kinematics) {
    AxisSet axes{axis};
    for (AxisSet before; before != axes;) {
        before = axes;
        for (const MotorIndex m : kinematics.motors_of_axes(before)) { axes |= kinematics.axes_of_motor(m); }
    }
    return kinematics.motors_of_axes(axes);
}

std::optional<AxisState> axis_state_of(AxisIndex axis, const Kinematics& kinematics,
                                       std::span<const AxisState* const> motors) {
    if (const auto own = kinematics.own_motor(axis)) {
        return motors[*own] == nullptr ? std::nullopt : std::optional(state_by_own(axis, *own, kinematics, motors));
    }
    const MotorSet needed = motors_needed_for(axis, kinematics);
    const MotorSet own = kinematics.motors_of_axes({axis});
    const AxisState* const newest = newest_of(needed, motors);
    std::vector<Position> places(motors.size());
    std::optional<AxisState> state;
    for (const MotorIndex m : needed) {
        if (motors[m] == nullptr) { return std::nullopt; }
        const AxisState& motor = *motors[m];
        places[m] = place_at(*newest, motor);
        if (!state) {
            state = motor;
            state->switches = {};
            state->inputs = {};  // those of its motors, which are different devices
            state->outputs = {};
            state->pulses_left = {};
            state->analog = {};
        }
        if (own.contains(m)) { state->switches = any_of(state->switches, motor.switches); }
        if (state->fault == FaultCode::None && motor.fault != FaultCode::None) {
            state->fault = motor.fault;
            state->phase = motor.phase;
        }
        if (state->unproved == FaultCode::None) { state->unproved = motor.unproved; }
        state->homed = state->homed && motor.homed;
        state->at_rest = state->at_rest && motor.at_rest;
        state->hears_owner = state->hears_owner && motor.hears_owner;
        state->clock_error = std::max(state->clock_error, motor.clock_error);
        state->stamp = std::min(state->stamp, motor.stamp);
    }
    state->axis = static_cast<std::uint32_t>(axis);
    state->tick = newest->tick;
    state->position = Position::steps(std::llround(kinematics.axis_steps(axis, places)));
    state->velocity = {};
    return state;
}

double axis_speed_of(AxisIndex axis, const Kinematics& kinematics, std::span<const AxisState* const> motors) {
    std::vector<Position> places(motors.size());
    std::vector<double> speeds(motors.size());
    for (const MotorIndex m : motor_indices(motors.size())) {
        if (motors[m] == nullptr) { continue; }
        places[m] = motors[m]->position;
        speeds[m] = motors[m]->velocity.steps_per_tick();
    }
    return kinematics.axis_speed(axis, places, speeds);
}

}  // namespace lockstep
