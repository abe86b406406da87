#include "services/virtual/home_switches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep {

HomeSwitches::HomeSwitches(const MachineConfig& machine) : kinematics_(machine) {
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        const AxisConfig& axis = machine.axes[i];
        const auto input = std::ranges::find(machine.inputs, axis.homing.input, &InputConfig::name);
        if (!row_of(axis.homing.way).runs_programs || input == machine.inputs.end()) { continue; }
        switches_.push_back({.input = static_cast<std::size_t>(input - machine.inputs.begin()),
                             .axis = i,
                             .at_steps = axis.homing.switch_position_mm * axis.steps_per_mm,
                             .toward_min = axis.homing.toward_min});
    }
}

void HomeSwitches::follow(const std::vector<double>& motors_mm, const std::function<void(std::size_t, bool)>& set) {
    std::vector<Position> motors;
    for (std::size_t m = 0; m < motors_mm.size(); ++m) {
        motors.push_back(Position::steps(to_steps(kinematics_.motors()[m], motors_mm[m])));
    }
    for (Switch& one : switches_) {
        const double at = one.axis_steps = kinematics_.axis_steps(one.axis, motors);
        const bool is_closed = one.toward_min ? at <= one.at_steps : at >= one.at_steps;
        if (is_closed != one.is_closed) { set(one.input, is_closed); }
        one.is_closed = is_closed;
    }
}

bool HomeSwitches::may_change_next() {
    constexpr double kLeast_steps = 2;
    bool may_change = false;
    for (Switch& one : switches_) {
        const double way = std::abs(one.axis_steps - std::exchange(one.begun_at_steps, one.axis_steps));
        may_change |= std::abs(one.axis_steps - one.at_steps) <= 3 * way + kLeast_steps;
    }
    return may_change;
}

}  // namespace lockstep
