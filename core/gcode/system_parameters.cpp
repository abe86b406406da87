#include "core/gcode/system_parameters.hpp"

#include "core/gcode/run/compensation.hpp"

namespace lockstep::gcode {
namespace {

constexpr double kMillimetresPerInch = 25.4;

double flag(bool value) { return value ? 1 : 0; }

double in_units(const State& state, std::size_t axis, double value) {
    return state.modal.inches && !is_turning(axis) ? value / kMillimetresPerInch : value;
}

std::optional<std::size_t> axis_of(std::string_view name) {
    if (name.size() != 2 || name[0] != '_') { return std::nullopt; }
    const std::size_t axis = kAxisLetters.find(static_cast<char>(name[1] - 'a' + 'A'));
    return axis == std::string_view::npos ? std::nullopt : std::optional(axis);
}

/// 540 is G54, 591 is G59.1.
double code_of_system(std::size_t system) {
    return system < 6 ? 540 + 10 * static_cast<double>(system) : 585 + static_cast<double>(system);
}

double plane_code(Plane plane) { return plane == Plane::XY ? 170 : plane == Plane::ZX ? 180 : 190; }

using Value = double (*)(const State&);
struct NamedValue {
    std::string_view name;
    Value value;
};

constexpr std::array kModes{
    NamedValue{"_motion_mode", [](const State& s) { return s.modal.motion == kNoMotion ? 800.0 : s.modal.motion; }},
    NamedValue{"_plane", [](const State& s) { return plane_code(s.modal.plane); }},
    NamedValue{"_ccomp",
               [](const State& s) {
                   return s.modal.side == Side::None ? 400.0 : s.modal.side == Side::Left ? 410.0 : 420.0;
               }},
    NamedValue{"_metric", [](const State& s) { return flag(!s.modal.inches); }},
    NamedValue{"_imperial", [](const State& s) { return flag(s.modal.inches); }},
    NamedValue{"_absolute", [](const State& s) { return flag(!s.modal.relative); }},
    NamedValue{"_incremental", [](const State& s) { return flag(s.modal.relative); }},
    NamedValue{"_inverse_time", [](const State& s) { return flag(s.modal.feed_mode == FeedMode::InverseTime); }},
    NamedValue{"_units_per_minute", [](const State& s) { return flag(s.modal.feed_mode == FeedMode::PerMinute); }},
    NamedValue{"_units_per_rev", [](const State&) { return 0.0; }},
    NamedValue{"_coord_system", [](const State& s) { return code_of_system(s.modal.system); }},
    NamedValue{"_tool_offset", [](const State& s) { return flag(s.offsets.tool != Point{}); }},
    NamedValue{"_retract_r_plane", [](const State& s) { return flag(!s.modal.retract_to_start); }},
    NamedValue{"_retract_old_z", [](const State& s) { return flag(s.modal.retract_to_start); }},
    NamedValue{"_spindle_rpm_mode", [](const State&) { return 1.0; }},
    NamedValue{"_spindle_css_mode", [](const State&) { return 0.0; }},
    NamedValue{"_ijk_absolute_mode", [](const State& s) { return flag(s.modal.centres_absolute); }},
    NamedValue{"_lathe_diameter_mode", [](const State&) { return 0.0; }},
    NamedValue{"_lathe_radius_mode", [](const State&) { return 1.0; }},
    NamedValue{"_spindle_on", [](const State& s) { return flag(s.modal.spindle != SpindleDirection::Stopped); }},
    NamedValue{"_spindle_cw", [](const State& s) { return flag(s.modal.spindle == SpindleDirection::Forward); }},
    NamedValue{"_mist", [](const State& s) { return flag(s.modal.mist); }},
    NamedValue{"_flood", [](const State& s) { return flag(s.modal.flood); }},
    NamedValue{"_speed_override", [](const State& s) { return flag(s.modal.speed_override); }},
    NamedValue{"_feed_override", [](const State& s) { return flag(s.modal.feed_override); }},
    NamedValue{"_adaptive_feed", [](const State& s) { return flag(s.modal.adaptive_feed); }},
    NamedValue{"_feed_hold", [](const State& s) { return flag(s.modal.feed_hold); }},
    NamedValue{"_feed", [](const State& s) { return in_units(s, 0, s.modal.feed_linear); }},
    NamedValue{"_rpm", [](const State& s) { return s.modal.spindle_speed; }},
    NamedValue{"_current_tool", [](const State& s) { return static_cast<double>(s.tool); }},
    NamedValue{"_selected_tool", [](const State& s) { return static_cast<double>(s.selected_tool); }},
    NamedValue{"_vmajor", [](const State&) { return 2.0; }},
    NamedValue{"_vminor", [](const State&) { return 9.0; }},
    NamedValue{"_task", [](const State&) { return 0.0; }},
};

/// #5400 to #5413: the tool in the spindle.
double numbered_tool(const State& state, int number) {
    const auto found = state.tools.find(state.tool);
    const Tool tool = found == state.tools.end() ? Tool{} : found->second;
    switch (number) {
        case 5400: return state.tool;
        case 5410: return tool.diameter;
        case 5411: return tool.front_angle;
        case 5412: return tool.back_angle;
        case 5413: return tool.orientation;
        default: return tool.offset[static_cast<std::size_t>(number - 5401)];
    }
}

}  // namespace

/// #5400 to #5413: the tool in the spindle; #5420 to #5428: where the axes stand, in the program's coordinates.
std::optional<double> SystemParameters::numbered(int number) const {
    if (number >= 5400 && number <= 5413) { return numbered_tool(state_, number); }
    if (number < 5420 || number > 5428) { return std::nullopt; }
    const auto axis = static_cast<std::size_t>(number - 5420);
    return in_units(state_, axis, shown_place(state_)[axis]);
}

std::optional<double> SystemParameters::named(std::string_view name) const {
    if (const auto axis = axis_of(name)) { return in_units(state_, *axis, shown_place(state_)[*axis]); }
    if (!name.starts_with('_')) { return std::nullopt; }
    if (name.starts_with("_abs_")) {
        const auto axis = axis_of(name.substr(4));
        return axis ? std::optional(in_units(state_, *axis, state_.machine[*axis])) : std::nullopt;
    }
    if (name == "_value") { return stack_.returned().value_or(0); }
    if (name == "_value_returned") { return flag(stack_.returned().has_value()); }
    if (name == "_line") { return line_.number(); }
    if (name == "_call_level") { return static_cast<double>(stack_.calls()); }
    for (const NamedValue& mode : kModes) {
        if (mode.name == name) { return mode.value(state_); }
    }
    return std::nullopt;
}

}  // namespace lockstep::gcode
