#include "services/documents/rules/homing_input_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/coordinator/program/probe_check.hpp"
#include "core/kinematics/motors.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

bool is_of_delta(const AxisConfig& axis, const MachineConfig& machine) {
    const auto& delta = machine.kinematics.delta;
    return delta && (axis.name == delta->x || axis.name == delta->y || axis.name == delta->z);
}

void check_overshoot(const MachineConfig& machine, const AxisConfig& axis, const InputConfig& input,
                     ProblemList& problems) {
    const double speed = axis.homing.search_velocity_mm_s;
    const Braking braking = Braking::of_axis(machine, machine.axis_named(axis.name).value());
    const double behind = overshoot_mm(machine, input, speed, braking);
    const double most = greatest_probing_feed_mm_s(machine, input, braking);
    problems.require(
        behind <= input.max_overshoot_mm, "homing.search_velocity_mm_s",
        fmt::format("homing.search_velocity_mm_s is {}, with which the axis may go on for {} mm behind its switch, and "
                    "max_overshoot_mm of input {} is {}; use at most {}, or shorter slots (timing), or raise "
                    "max_overshoot_mm if the switch bears it",
                    number_text(speed), number_text(behind, 4), input.name, number_text(input.max_overshoot_mm),
                    number_text(std::floor(most * 1e3) / 1e3)));
}

}  // namespace

void check_homing_input(const MachineConfig& machine, const AxisConfig& axis, ProblemList& problems) {
    const HomingConfig& homing = axis.homing;
    if (homing.input.empty()) { return; }
    const auto input = std::ranges::find(machine.inputs, homing.input, &InputConfig::name);
    const bool is_switch = input != machine.inputs.end() && input->use == InputUse::Home;
    problems.require(is_switch, "homing.input",
                     fmt::format("homing.input is \"{}\"; write an input with this name and use: HOME, or remove it if "
                                 "the switch is wired to the axis's own device",
                                 homing.input));
    problems.require(homing.way != HomingWay::InPlace, "homing.input",
                     "homing.input is given, but in_place: true says that the axis has no switch; remove one");
    problems.require(
        axis.motors.size() < 2, "homing.input",
        "homing.input is given, but the axis has several motors: one switch does not show which of them is "
        "ahead, so it cannot make them square; remove it, and wire a switch for each motor to its own "
        "device, or square them by hand and set in_place: true");
    problems.require(!is_of_delta(axis, machine), "homing.input",
                     "homing.input is given, but the axis is of a delta, whose carriages home by their own switches; "
                     "remove it");
    problems.require(
        !corrects_screw(machine, machine.axis_named(axis.name).value()), "homing.input",
        "homing.input is given, and a motor of the axis corrects its screw: until the axis is homed nobody "
        "knows which part of the screw moves it, so the way from the switch would be wrong; remove screw, "
        "or wire the switch to the device of the axis's motor and remove input");
    if (is_switch) { check_overshoot(machine, axis, *input, problems); }
}

}  // namespace lockstep
