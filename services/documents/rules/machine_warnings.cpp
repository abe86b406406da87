#include "services/documents/rules/machine_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/gcode/motion.hpp"

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

}  // namespace

std::vector<std::string> machine_warnings(const MachineConfig& machine) {
    const std::string letters = free_letters(machine);
    std::vector<std::string> warnings;
    for (const AxisConfig& axis : machine.axes) {
        if (gcode::axis_place(axis.name)) { continue; }
        warnings.push_back(fmt::format(
            "axis {}: no word of G-code names it, so no program moves it; only jogs and lockstep home and move do{}",
            axis.name, (letters.empty() ? "" : "; to use it in programs, set its name to one of:" + letters)));
    }
    return warnings;
}

}  // namespace lockstep
