#include "services/documents/rules/pin_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/kinematics/motors.hpp"
#include "services/documents/rules/axis_ranges.hpp"

namespace lockstep {
namespace {

constexpr double kMaxPulse_us = 1000;
constexpr double kMaxEnableWait_ms = 10'000;

/// The block that has the motor's pins: its own, or that of its axis.
std::string place_of(const AxisConfig& axis, const std::string& motor) {
    const auto block = std::ranges::find(axis.motors, motor, &MotorBlock::name);
    const bool has_own = block != axis.motors.end() && block->pins;
    return has_own ? fmt::format("motor[{}].pins.", block - axis.motors.begin()) : "pins.";
}

/// Between two steps at the greatest speed there is room for the pulse and for a change of direction.
void check_room(const MachineConfig& machine, const MotorConfig& motor, std::vector<Problem>& found) {
    const AxisConfig& axis = machine.axes[*motor.axis];
    ProblemList problems(*motor.axis, "axis " + axis.name + ": ");
    const std::string at = place_of(axis, motor.name);
    const double between_us = 1e6 / (motor.max_velocity_mm_s * motor.steps_per_mm);
    const std::string room = fmt::format("motor {} makes steps {} us apart at max_velocity_mm_s {}", motor.name,
                                         number_text(between_us), number_text(motor.max_velocity_mm_s));
    const PinsConfig& pins = motor.pins;
    problems.require(
        axis_ranges::is_at_most(2 * pins.step_width_us, between_us), at + "step_width_us",
        fmt::format(
            "step_width_us is {}, and {}: a pulse and the time to the next are longer; it must be at most {}, or "
            "decrease max_velocity_mm_s or steps_per_mm",
            number_text(pins.step_width_us), room, number_text(between_us / 2)));
    const double turn_us = pins.direction_setup_us + pins.direction_hold_us;
    problems.require(
        axis_ranges::is_at_most(turn_us, between_us), at + "direction_setup_us",
        fmt::format("direction_setup_us and direction_hold_us are {} together, and {}; they must be at most that, or "
                    "decrease max_velocity_mm_s or steps_per_mm",
                    number_text(turn_us), room));
    std::ranges::move(problems.take(), std::back_inserter(found));
}

}  // namespace

void check_pin_ranges(const PinsConfig& pins, const std::string& at, ProblemList& problems) {
    problems.require_range(at + "step_width_us", pins.step_width_us, 0, kMaxPulse_us);
    problems.require_range(at + "direction_setup_us", pins.direction_setup_us, 0, kMaxPulse_us);
    problems.require_range(at + "direction_hold_us", pins.direction_hold_us, 0, kMaxPulse_us);
    problems.require_range(at + "enable_wait_ms", pins.enable_wait_ms, 0, kMaxEnableWait_ms);
}

std::vector<Problem> pin_problems(const MachineConfig& machine) {
    std::vector<Problem> found;
    for (const MotorConfig& motor : motors_of(machine)) {
        if (!motor.is_board()) { check_room(machine, motor, found); }
    }
    return found;
}

}  // namespace lockstep
