#include "tests/simulation/simtest/run/play/move_slides.hpp"

#include <algorithm>
#include <cmath>

#include "core/kinematics/following_error.hpp"
#include "tests/simulation/simtest/run/play/play_correction.hpp"

namespace lockstep::simtest {
namespace {

std::int64_t place_of(Bench& bench, MotorIndex m) {
    return std::llround(bench.vm().device(m).plant().position_mm() * bench.kinematics().motors()[m].steps_per_mm);
}

/// Axes that home together with others by touch are not put to their parks, if they have no switch. A distance that the
/// motor would not notice is left, but not where slides are pushed again and again: they would reach their limit
/// switches.
bool put_to_park(Bench& bench) {
    bool moves = false;
    const MotorSet& by_touch = bench.homed_by_touch();
    const bool is_exact = corrects(bench.machine());
    for (const MotorIndex m : motor_indices(bench.kinematics().motors().size())) {
        const MotorConfig& motor = bench.kinematics().motors()[m];
        if (row_of(motor.homing.way).searches || by_touch.contains(m)) { continue; }
        const double off_mm = motor.homing.park_mm - bench.vm().device(m).plant().position_mm();
        const std::int64_t steps = std::llround(off_mm * motor.steps_per_mm);
        if (std::abs(steps) <= (is_exact ? 0 : most_following_error(motor))) { continue; }
        bench.move_by_hand(m, steps);
        moves = true;
    }
    return moves;
}

/// If one of two belts stops at once, and the other one brakes, both axes rest elsewhere than planned, perhaps outside
/// their travel. While the first of them is homed, the other one stays there, and a motor could reach its limit switch.
bool put_into_travel(Bench& bench) {
    MotorCounts motors;
    for (const MotorIndex m : motor_indices(bench.kinematics().motors().size())) {
        motors.steps.append(place_of(bench, m));
    }
    AxisCounts axes = bench.kinematics().axes_at(motors);
    bool moves = false;
    for (const AxisIndex i : axis_indices(axes.size())) {
        const AxisConfig& axis = bench.machine().axes[i];
        const MotorSet of_axis = bench.kinematics().motors_of_axes(AxisSet{i});
        if (of_axis.empty() || !bench.homed_by_touch().contains(of_axis.front())) { continue; }
        const std::int64_t inside =
            std::clamp(axes[i], to_steps(axis, axis.position_min_mm), to_steps(axis, axis.position_max_mm));
        const double outside_mm = std::abs(to_mm(axis, static_cast<double>(axes[i] - inside)));
        if (outside_mm <= axis.plant.travel_margin_mm / 2) { continue; }
        axes[i] = inside;
        moves = true;
    }
    if (!moves) { return false; }
    const MotorCounts put = bench.kinematics().motors_at(axes);
    for (const MotorIndex m : bench.homed_by_touch()) { bench.move_by_hand(m, put[m] - motors[m]); }
    return true;
}

}  // namespace

void move_slides_before_homing(Bench& bench) {
    const bool parks = put_to_park(bench);
    const bool enters = put_into_travel(bench);
    if (parks || enters) { bench.wait_slots(bench.lossy() ? 40 : 6); }
}

}  // namespace lockstep::simtest
