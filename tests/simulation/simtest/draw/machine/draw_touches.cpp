#include "tests/simulation/simtest/draw/machine/draw_touches.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "core/coordinator/program/probe_check.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/kinematics/motors.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/draw_bounces.hpp"
#include "tests/simulation/simtest/draw/draw_machine.hpp"

namespace lockstep::simtest {
namespace {

constexpr int kHomeChannel = 7;
constexpr double kMostOvershoot_mm = 1000;
constexpr double kMostSlots = 4000;  // of a search

/// From the switch to the limit switch behind it, less two steps.
double room_mm(const AxisConfig& axis) {
    const double margin = axis.plant.travel_margin_mm - 2 / axis.steps_per_mm;
    const double at = axis.homing.switch_position_mm;
    return margin + (axis.homing.toward_min ? at - axis.position_min_mm : axis.position_max_mm - at);
}

std::optional<InputConfig> draw_switch(Draw& draw, const MachineConfig& machine, const AxisConfig& axis) {
    const std::size_t motor = draw.index(motor_count(machine));
    const InputConfig input{.name = axis.name + "h",
                            .motor = motor_name(machine, MotorIndex{motor}),
                            .at_board = motor >= moving_motor_count(machine),
                            .channel = kHomeChannel,
                            .use = InputUse::Home,
                            .active_low = draw.chance(0.3),
                            .debounce_ms = draw.chance(0.3) ? 0 : draw.magnitude(0.01, 2),
                            .max_overshoot_mm = std::min(room_mm(axis), kMostOvershoot_mm)};
    const bool is_taken = std::ranges::count(machine.inputs, input.motor, &InputConfig::motor) > 0;
    return !is_taken && input.max_overshoot_mm > 0.001 ? std::optional(input) : std::nullopt;
}

/// Leaves the axis as it is if its searches would take too long.
bool give_switch(Draw& draw, AxisConfig& axis, MachineConfig& machine) {
    if (corrects_screw(machine, machine.axis_named(axis.name).value())) { return false; }  // it does not home by touch
    const auto input = draw_switch(draw, machine, axis);
    if (!input) { return false; }
    AxisConfig slower = axis;
    const Braking braking = Braking::of_axis(machine, machine.axis_named(axis.name).value());
    const double most = 0.99 * greatest_probing_feed_mm_s(machine, *input, braking);
    slower.homing.search_velocity_mm_s = std::min(axis.homing.search_velocity_mm_s, most);
    slower.homing.latch_velocity_mm_s = std::min(axis.homing.latch_velocity_mm_s, slower.homing.search_velocity_mm_s);
    if (search_slots(slower, machine.timing) > kMostSlots) { return false; }
    slower.homing.way = HomingWay::ByTouch;
    slower.homing.input = input->name;
    axis = slower;
    machine.inputs.push_back(*input);
    return true;
}

bool shares_motors(const MachineConfig& machine) {
    const auto is_in_place = [](const AxisConfig& axis) { return axis.homing.way == HomingWay::InPlace; };
    return machine.axes.size() >= 2 && is_in_place(machine.axes[0]) && is_in_place(machine.axes[1]);
}

/// Axes that share motors are homed in place, at their parks, or both by touch, from near their switches.
void give_switches_to_first_two(Draw& draw, MachineConfig& machine) {
    MachineConfig changed = machine;
    for (std::size_t i = 0; i < 2; ++i) {
        AxisConfig& axis = changed.axes[i];
        if (!give_switch(draw, axis, changed)) { return; }
        const double travel = axis.position_max_mm - axis.position_min_mm;
        const double off = draw.real(-0.5, 1) * std::min(0.5 * travel, axis.homing.search_velocity_mm_s);
        const double start = axis.homing.switch_position_mm + (axis.homing.toward_min ? off : -off);
        axis.plant.start_position_mm = std::clamp(start, axis.position_min_mm, axis.position_max_mm);
    }
    machine = changed;
}

}  // namespace

MachineConfig with_touches(std::uint64_t seed, MachineConfig machine) {
    Draw draw(seed ^ 0x70c4e5000000000U);
    const std::vector<AxisConfig> axes = machine.axes;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        AxisConfig& axis = machine.axes[i];
        if (axis.motors.size() >= 2 || axis.homing.way == HomingWay::InPlace || !draw.chance(0.5)) { continue; }
        (void)give_switch(draw, axis, machine);
    }
    if (shares_motors(machine) && draw.chance(0.8)) { give_switches_to_first_two(draw, machine); }
    return machine;
}

void put_limits_behind_errors(MachineConfig& machine) {
    const double clocks_s =
        machine.estimates_clocks() ? 2e-6 * static_cast<double>(machine.timing.clock_error_limit_us) : 0;
    for (AxisConfig& axis : machine.axes) {
        if (axis.homing.way != HomingWay::ByTouch) { continue; }
        const auto input = std::ranges::find(machine.inputs, axis.homing.input, &InputConfig::name);
        axis.plant.travel_margin_mm += axis.homing.latch_velocity_mm_s * (clocks_s + bounce_seconds(*input));
    }
}

}  // namespace lockstep::simtest
