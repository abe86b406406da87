#include "services/documents/rules/machine_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/gcode/motion.hpp"
#include "core/number_text.hpp"

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

}  // namespace

std::vector<std::string> machine_warnings(const MachineConfig& machine) {
    const std::string letters = free_letters(machine);
    std::vector<std::string> warnings;
    WeakMotors motors(warnings);
    for (const AxisConfig& axis : machine.axes) {
        motors.check(axis);
        if (gcode::axis_place(axis.name)) { continue; }
        warnings.push_back(fmt::format(
            "axis {}: no word of G-code names it, so no program moves it; only jogs and lockstep home and move do{}",
            axis.name, (letters.empty() ? "" : "; to use it in programs, set its name to one of:" + letters)));
    }
    return warnings;
}

}  // namespace lockstep
