#include "clients/web/program/values_edit.hpp"

#include <fmt/format.h>

#include "clients/web/request/body_reader.hpp"
#include "core/gcode/gcode.hpp"
#include "core/number_text.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep::web {
namespace {

void set_letters(const Letters& letters, gcode::Point& place) {
    for (const auto& [letter, value] : letters) { place[gcode::kAxisLetters.find(letter)] = value; }
}

}  // namespace

std::expected<gcode::KeptValues, Problem> edited(const TouchOrder& order, const gcode::KeptValues& values,
                                                 const MachineSetup& machine, const std::vector<double>& place_mm) {
    std::string line = fmt::format("G21 G10 L20 P{}", order.system + 1);
    for (const auto& [letter, value] : order.places) { line += " " + std::string(1, letter) + number_text(value); }
    GcodeSetup setup = gcode_setup(machine, place_mm, "touch");
    setup.values = values;
    auto reading = read_gcode(line + "\nM2\n", setup);
    if (!reading) {
        return std::unexpected(
            wrong_value(422, "/axes", line, "valid for G10 L20: " + reading.error().front().message));
    }
    return std::move(reading->values);
}

std::expected<gcode::KeptValues, Problem> edited(const OffsetOrder& order, gcode::KeptValues values) {
    gcode::CoordinateSystem& system = values.systems[order.system];
    set_letters(order.origin, system.origin);
    system.rotation = order.rotation_deg.value_or(system.rotation);
    return values;
}

std::expected<gcode::KeptValues, Problem> edited(const ToolOrder& order, gcode::KeptValues values) {
    const bool is_known = values.tools.contains(order.number);
    if (order.removes && !is_known) {
        return std::unexpected(wrong_value(422, "/number", order.number, "the number of a tool in the table"));
    }
    if (order.removes) {
        values.tools.erase(order.number);
        return values;
    }
    if (!is_known && values.tools.size() >= gcode::kMaxTools) {
        return std::unexpected(
            wrong_value(422, "/number", order.number,
                        fmt::format("a tool in the table, because the table is full with {} tools", gcode::kMaxTools)));
    }
    gcode::Tool& tool = values.tools[order.number];
    tool.pocket = order.pocket.value_or(tool.pocket);
    tool.diameter = order.diameter.value_or(tool.diameter);
    set_letters(order.offset, tool.offset);
    return values;
}

}  // namespace lockstep::web
