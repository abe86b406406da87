#include "sim_fpga/contacts/axis_switches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep {

AxisSwitches::AxisSwitches(const MachineConfig& machine, const std::string& motor) : kinematics_(machine) {
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const AxisConfig& axis = machine.axes[i];
        for (std::size_t n = 0; n < machine.inputs.size(); ++n) {
            const InputConfig& input = machine.inputs[n];
            if (!motor.empty() && input.motor != motor) { continue; }
            const bool is_home = row_of(axis.homing.way).runs_programs && input.name == axis.homing.input;
            if (is_home) { add(n, i, machine, axis.homing.switch_position_mm, axis.homing.toward_min); }
            if (!input.is_limit_by_message() || input.axis != axis.name) { continue; }
            const bool at_min = input.use == InputUse::LimitMin;
            const double margin = axis.plant.travel_margin_mm;
            add(n, i, machine, at_min ? axis.position_min_mm - margin : axis.position_max_mm + margin, at_min);
        }
    }
}

void AxisSwitches::add(std::size_t input, AxisIndex axis, const MachineConfig& machine, double at_mm, bool toward_min) {
    const AxisConfig& config = machine.axes[axis];
    switches_.push_back({.input = input,
                         .axis = axis,
                         .at_steps = at_mm * config.steps_per_mm,
                         .toward_min = toward_min,
                         .steps_per_mm = config.steps_per_mm,
                         .reach = Reach::of(config, machine)});
}

void AxisSwitches::follow(std::span<const Position> slides, const std::function<void(std::size_t, bool)>& set) {
    for (Switch& one : switches_) {
        const double at = one.axis_steps = kinematics_.axis_steps(one.axis, slides);
        const bool is_closed = one.toward_min ? at <= one.at_steps : at >= one.at_steps;
        if (is_closed != one.is_closed) { set(one.input, is_closed); }
        one.is_closed = is_closed;
    }
}

bool AxisSwitches::may_change_within(Ticks next) {
    constexpr double kRounded_steps = 2;
    const Ticks last = std::exchange(interval_, next);
    bool may_change = false;
    for (Switch& one : switches_) {
        const double way = std::abs(one.axis_steps - std::exchange(one.begun_at_steps, one.axis_steps));
        const double reach = one.reach.mm(way / one.steps_per_mm, last, next) * one.steps_per_mm + kRounded_steps;
        may_change |= std::abs(one.axis_steps - one.at_steps) <= reach;
    }
    return may_change;
}

}  // namespace lockstep
