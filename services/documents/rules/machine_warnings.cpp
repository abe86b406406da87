#include "services/documents/rules/machine_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/gcode/motion.hpp"
#include "core/number_text.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {
namespace {

/// The letters that no axis has, each after a space.
std::string free_letters(const MachineConfig& machine) {
    std::string text;
    for (std::size_t i = 0; i < gcode::kAxes; ++i) {
        const bool is_used = std::ranges::any_of(
            machine.axes, [i](const AxisConfig& axis) { return gcode::axis_place(axis.name) == i; });
        if (!is_used) { text += std::string(" ") + gcode::kAxisLetters[i]; }
    }
    return text;
}

class WeakMotors {
public:
    explicit WeakMotors(std::vector<std::string>& warnings) : warnings_(warnings) {}

    void check(const AxisConfig& axis) {
        if (axis.device.kind != DeviceName::Kind::Simulated) { return; }
        const double torque = axis.plant.max_torque_accel_mm_s2;
        compare(axis, "plant.max_torque_accel_mm_s2", torque, "max_accel_mm_s2", axis.max_accel_mm_s2);
        compare(axis, "plant.max_torque_accel_mm_s2", torque, "max_decel_mm_s2", axis.max_decel_mm_s2);
        compare(axis, "plant.max_jump_mm_s", axis.plant.max_jump_mm_s, "start_velocity_mm_s", axis.start_velocity_mm_s);
    }

private:
    void compare(const AxisConfig& axis, const std::string& key, double can, const std::string& limit, double may) {
        if (can >= may) { return; }
        warnings_.push_back("axis " + axis.name + ": " + key + " is " + number_text(can) + ", below " + limit + " " +
                            number_text(may) + ", so the simulated motor may lose steps; increase it, or decrease " +
                            limit);
    }

    std::vector<std::string>& warnings_;
};

/// Each motor's process begins to search when its order arrives, and it may stall before.
void check_skew(const MachineConfig& machine, const AxisConfig& axis, std::vector<std::string>& warnings) {
    if (axis.motors.size() < 2 || !axis.max_skew_mm || !row_of(axis.homing.way).searches) { return; }
    const ProtocolTiming& t = machine.timing;
    const double late_s = 1e-6 * static_cast<double>(t.slot_us) * (t.stall_slots + rules::kHopSlots);
    const double behind_mm = late_s * axis.homing.search_velocity_mm_s;
    if (*axis.max_skew_mm >= behind_mm) { return; }
    warnings.push_back(fmt::format(
        "axis {}: max_skew_mm is {}; a motor whose process stalls for timing.stall_slots as homing begins is {} mm "
        "behind the others, and homing stops with motors-skewed; increase max_skew_mm, or decrease "
        "homing.search_velocity_mm_s",
        axis.name, number_text(*axis.max_skew_mm), number_text(behind_mm)));
}

}  // namespace

std::vector<std::string> machine_warnings(const MachineConfig& machine) {
    const std::string letters = free_letters(machine);
    std::vector<std::string> warnings;
    WeakMotors motors(warnings);
    for (const AxisConfig& axis : machine.axes) {
        motors.check(axis);
        check_skew(machine, axis, warnings);
        if (gcode::axis_place(axis.name)) { continue; }
        warnings.push_back(fmt::format(
            "axis {}: no word of G-code names it, so no program moves it; only jogs and lockstep home and move do{}",
            axis.name, (letters.empty() ? "" : "; to use it in programs, set its name to one of:" + letters)));
    }
    return warnings;
}

}  // namespace lockstep
