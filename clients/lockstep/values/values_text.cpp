#include "clients/lockstep/values/values_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/gcode/gcode.hpp"
#include "core/gcode/system_names.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

using gcode::KeptValues;
using gcode::Point;

constexpr std::size_t kNameWidth = 7;

std::string places_text(const MachineSetup& machine, const Point& place) {
    std::string text;
    for (const AxisConfig& axis : machine.axes) {
        if (const auto letter = gcode::axis_place(axis.name)) {
            text += "  " + axis.name + " " + number_text(place[*letter]);
        }
    }
    return text;
}

std::string row(std::string name, const std::string& text) {
    name.resize(std::max(name.size(), kNameWidth), ' ');
    return "  " + name + text + "\n";
}

}  // namespace

std::string offsets_text(const MachineSetup& machine, const KeptValues& values) {
    std::string text;
    for (std::size_t i = 0; i < gcode::kSystems; ++i) {
        const gcode::CoordinateSystem& system = values.systems[i];
        if (system == gcode::CoordinateSystem{}) { continue; }
        const std::string turned = system.rotation == 0 ? "" : "  R " + number_text(system.rotation);
        text += row(name_of_system(i), places_text(machine, system.origin) + turned);
    }
    if (values.g92 != Point{}) {
        text += row("G92", places_text(machine, values.g92) + (values.g92_applies ? "" : "  off, until G92.3"));
    }
    if (values.home) { text += row("G28", places_text(machine, *values.home)); }
    if (values.second_home) { text += row("G30", places_text(machine, *values.second_home)); }
    if (text.empty()) { return "no offsets: every coordinate system has the machine's zero"; }
    text.pop_back();
    return "offsets of machine '" + machine.name + "':\n" + text;
}

std::string tools_text(const MachineSetup& machine, const KeptValues& values) {
    std::string text;
    for (const auto& [number, tool] : values.tools) {
        std::string line = places_text(machine, tool.offset) + "  D " + number_text(tool.diameter);
        if (tool.pocket != 0) { line += fmt::format("  P {}", tool.pocket); }
        if (tool.orientation != 0) { line += fmt::format("  Q {}", tool.orientation); }
        text += row(fmt::format("T{}", number), line);
    }
    if (text.empty()) { return "no tools; add one: lockstep tools set 1 Z=25.4 D=6"; }
    text.pop_back();
    return "tools of machine '" + machine.name + "':\n" + text;
}

}  // namespace lockstep
