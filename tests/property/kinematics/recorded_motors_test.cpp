// Where the motors of drawn machines are, what limits they have, and what the states of motors say of their axes, stay
// as recorded. To write the files: LOCKSTEP_WRITE_HASHES=1 build/bin/property_kinematics
#include <cmath>

#include "core/kinematics/axis_states.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/motion/frame_limits.hpp"
#include "core/motion/moves.hpp"
#include "tests/property/recorded_hashes.hpp"
#include "tests/property/recorded_text.hpp"
#include "tests/simulation/simtest/draw/draw_machine.hpp"
#include "tests/simulation/simtest/draw/machine/draw_delta.hpp"
#include "tests/simulation/simtest/draw/machine/draw_motors.hpp"
#include "tests/simulation/simtest/draw/machine/draw_screws.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kMachines = 400;

using simtest::Draw;

/// Motors of their own, shared motors, deltas, and screws with errors, in turn.
MachineConfig draw_kind(std::uint32_t number) {
    Draw draw(number);
    MachineConfig machine = simtest::draw_machine(draw, 3 + number % 3, false);
    switch (number % 5) {
        case 1: return simtest::with_motors(number, machine);
        case 2: return simtest::with_delta(number, machine);
        case 3: return simtest::with_screws(number, machine);
        case 4: return simtest::with_screws(number, simtest::with_motors(number, machine));
        default: return machine;
    }
}

void record(RecordedText& text, const AxisLimits& limits) {
    text.line(limits.start_velocity, limits.max_velocity, limits.max_acceleration, limits.max_deceleration,
              limits.min_steps, limits.max_steps);
}

void record_motors(RecordedText& text, const MachineConfig& machine) {
    for (const MotorConfig& motor : motors_of(machine)) {
        text.line(motor.name, motor.moves_one_axis, motor.steps_per_mm, motor.start_velocity_mm_s,
                  motor.max_velocity_mm_s, motor.max_accel_mm_s2, motor.max_decel_mm_s2, motor.position_min_mm,
                  motor.position_max_mm, motor.screw.knots(), motor.screw.most_slope(), motor.screw.most_bend());
    }
    for (const AxisLimits& limits : frame_limits_of(machine)) { record(text, limits); }
    for (const AxisLimits& limits : axis_frame_limits_of(machine)) { record(text, limits); }
    text.line(least_move(machine));
}

void record_axes(RecordedText& text, const Kinematics& kinematics) {
    text.line(kinematics.is_direct());
    for (const AxisIndex i : axis_indices(kinematics.axes())) {
        text.line(kinematics.rest_steps(i), kinematics.step_mm(i), kinematics.own_motor(i),
                  kinematics.motors_of_axes({i}), motors_needed_for(i, kinematics));
    }
    for (const MotorIndex m : motor_indices(kinematics.motors().size())) {
        text.line(kinematics.label(m), kinematics.is_named_as_axis(m), kinematics.axes_of_motor(m),
                  kinematics.corrects_screw(m));
    }
}

AxisCounts draw_place(Draw& draw, const MachineConfig& machine) {
    AxisCounts place;
    for (const AxisConfig& axis : machine.axes) {
        const double mm =
            draw.chance(0.1) ? axis.position_max_mm : draw.real(axis.position_min_mm, axis.position_max_mm);
        place.append(std::llround(mm * axis.steps_per_mm));
    }
    return place;
}

std::vector<AxisState> draw_states(Draw& draw, const MotorCounts& motors) {
    std::vector<AxisState> states;
    for (std::size_t m = 0; m < motors.size(); ++m) {
        AxisState state{.identity = m, .axis = static_cast<std::uint32_t>(m), .stamp = draw.whole(1, 5)};
        state.at_rest = draw.chance(0.8);
        state.homed = draw.chance(0.8);
        state.hears_owner = draw.chance(0.8);
        state.phase = static_cast<AxisPhase>(draw.whole(0, 6));
        state.fault = draw.chance(0.1) ? FaultCode::LimitHit : FaultCode::None;
        state.switches = {draw.chance(0.1), draw.chance(0.1), draw.chance(0.1)};
        const bool backward = draw.chance(0.5);
        state.position = rest_position(motors.steps[m] + draw.whole(-1, 1), backward);
        state.velocity.raw = draw.whole(-1'000'000, 1'000'000) << 24;
        state.tick = Tick{draw.whole(1000, 2000)};
        states.push_back(state);
    }
    return states;
}

void record_states(RecordedText& text, const Kinematics& kinematics, const std::vector<AxisState>& states) {
    std::vector<const AxisState*> of;
    for (const AxisState& state : states) { of.push_back(&state); }
    for (const AxisIndex i : axis_indices(kinematics.axes())) {
        const auto state = axis_state_of(i, kinematics, of);
        text.line(state.has_value(), axis_speed_of(i, kinematics, of));
        if (!state) { continue; }
        text.line(state->position, state->velocity, state->tick, state->homed, state->at_rest, state->hears_owner,
                  state->phase, state->fault, state->switches.limit_min, state->switches.limit_max,
                  state->switches.home, state->stamp);
    }
}

std::string motors_of(std::uint32_t number) {
    const MachineConfig machine = draw_kind(number);
    const Kinematics kinematics(machine);
    Draw draw(number);
    RecordedText text;
    record_motors(text, machine);
    record_axes(text, kinematics);
    for (int k = 0; k < 8; ++k) {
        MotorCounts motors = kinematics.motors_at(draw_place(draw, machine));
        text.line(motors.steps, kinematics.axes_at(motors));
        for (std::int64_t& steps : motors.steps) { steps += draw.whole(-40, 40) / 39; }
        const auto astray = kinematics.astray(motors);
        text.line(kinematics.axes_at(motors), astray.has_value());
        if (astray) { text.line(astray->motor, astray->off_mm); }
        record_states(text, kinematics, draw_states(draw, motors));
    }
    return text.text();
}

TEST(MotorsOfDrawnMachines, StayAsRecorded) {
    expect_recorded("tests/property/kinematics/motors.txt", kMachines,
                    [](std::uint32_t number) { return motors_of(number); });
}

}  // namespace
}  // namespace lockstep
