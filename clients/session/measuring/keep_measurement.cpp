#include "clients/session/measuring/keep_measurement.hpp"

#include "clients/session/move_program.hpp"
#include "clients/text/format.hpp"

namespace lockstep {

Changed keep_in_system(const MachineConfig& machine, std::string_view system, const proto::Measurement& measured,
                       double reads_mm, std::vector<double> start_mm, gcode::KeptValues& values) {
    if (measured.has_angle_deg()) {
        return set_offset(machine, system, {"R=" + fixed(measured.angle_deg(), 6)}, values);
    }
    ChangeWords words;
    const auto put = [&](bool is_measured, const char* axis, double mm) {
        if (!is_measured) { return; }
        start_mm[find_axis(machine, axis).value()] = mm;
        words.push_back(std::string(axis) + "=" + fixed(reads_mm, 6));
    };
    put(measured.has_x_mm(), "X", measured.x_mm());
    put(measured.has_y_mm(), "Y", measured.y_mm());
    if (words.empty()) {
        return std::unexpected("a measurement of kind " + measured.kind() +
                               " has no place; measure an edge, a corner, a bore or a boss");
    }
    return touch_off(machine, start_mm, system, words, values);
}

Changed keep_in_system(const MachineConfig& machine, std::string_view system, const proto::ProbeReport& touch,
                       const std::vector<std::string>& moved, double reads_mm, gcode::KeptValues& values) {
    if (!touch.touched()) { return std::unexpected("the probe has not touched, so there is no place; probe again"); }
    std::vector<double> places_mm;
    for (const proto::ProbePlace& place : touch.places()) { places_mm.push_back(place.position_mm()); }
    ChangeWords words;
    for (const std::string& axis : moved) { words.push_back(axis + "=" + fixed(reads_mm, 6)); }
    return touch_off(machine, places_mm, system, words, values);
}

Changed keep_in_tool(const MachineConfig& machine, int tool, const proto::Measurement& measured,
                     gcode::KeptValues& values) {
    if (!measured.has_tool_length_mm()) {
        return std::unexpected("a measurement of kind " + measured.kind() + " has no length; measure a tool");
    }
    return set_tool(machine, tool, {"Z=" + fixed(measured.tool_length_mm(), 6)}, values);
}

}  // namespace lockstep
