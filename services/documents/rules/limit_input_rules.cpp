#include "services/documents/rules/limit_input_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/coordinator/program/probe_check.hpp"
#include "core/kinematics/motors.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

/// The device of the axis's only motor knows the axis's direction and stops it.
bool moves_alone(const MotorConfig& motor, const MachineConfig& machine, AxisIndex axis) {
    return motor.axis == axis && motor.moves_one_axis && machine.axes[axis].motors.size() < 2;
}

/// With which the axis surely brakes from its max_velocity_mm_s, whatever else moves: on a path all brake together, and
/// the axis or motor that takes longest decides.
double sure_deceleration_mm_s2(const MachineConfig& machine, const AxisConfig& axis) {
    double longest_s = axis.max_velocity_mm_s / axis.max_decel_mm_s2;
    const auto brake = [&](const Moving auto& part) {
        if (part.max_decel_mm_s2 > 0) {
            longest_s = std::max(longest_s, part.max_velocity_mm_s / part.max_decel_mm_s2);
        }
    };
    std::ranges::for_each(machine.axes, brake);
    std::ranges::for_each(moving_motors_of(machine), brake);
    return axis.max_velocity_mm_s / longest_s;
}

void check_room(const MachineConfig& machine, const AxisConfig& axis, const InputConfig& input, const std::string& at,
                ProblemList& problems) {
    const std::string key = at + "max_overshoot_mm";
    const Braking braking(sure_deceleration_mm_s2(machine, axis));
    const double behind = overshoot_mm(machine, input, axis.max_velocity_mm_s, braking);
    const double most = greatest_probing_feed_mm_s(machine, input, braking);
    problems.require_between(
        {key, at + "debounce_ms"}, behind <= input.max_overshoot_mm || !(axis.max_decel_mm_s2 > 0),
        fmt::format("max_overshoot_mm of input {} is {}, and at its max_velocity_mm_s {} axis {} may go on for {} mm "
                    "behind the switch before a message has stopped it; wire the switch to the device of the axis's "
                    "motor and remove `axis`, or set max_velocity_mm_s to at most {}, or use shorter slots (timing), "
                    "or raise max_overshoot_mm if there is so much room behind the switch",
                    input.name, number_text(input.max_overshoot_mm), number_text(axis.max_velocity_mm_s), axis.name,
                    number_text(behind, 4), number_text(std::floor(most * 1e3) / 1e3)));
}

}  // namespace

void check_limit_input(const MachineConfig& machine, const InputConfig& input, const MotorConfig* motor,
                       const std::string& at, ProblemList& problems) {
    const std::string key = at + "axis";
    if (!input.is_limit()) {
        problems.require(input.axis.empty(), key,
                         fmt::format("{} is given, but the input is no limit switch; remove it, or set use: LIMIT_MIN "
                                     "or LIMIT_MAX",
                                     key));
        return;
    }
    if (input.axis.empty()) {
        problems.require(
            !input.at_board, at + "use",
            fmt::format("input {} is a limit switch at board {}, which has no motor to stop; name the axis "
                        "at whose end it is, so that the coordinator stops the machine, or wire the "
                        "switch to the device of the axis's motor",
                        input.name, input.motor));
        return;
    }
    const auto axis = machine.axis_named(input.axis);
    problems.require(axis.has_value(), key,
                     fmt::format("{} is \"{}\"; it must be the name of an axis of the machine", key, input.axis));
    if (!axis) { return; }
    const bool is_own = motor != nullptr && moves_alone(*motor, machine, *axis);
    problems.require(!is_own, key,
                     fmt::format("{} is given, but the device of motor {} stops axis {} by itself, at the next step; "
                                 "remove it",
                                 key, input.motor, input.axis));
    if (!is_own) { check_room(machine, machine.axes[*axis], input, at, problems); }
}

}  // namespace lockstep
