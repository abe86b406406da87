// The words of a session's modes.
#include "core/gcode/session/gcode_session.hpp"
#include "core/gcode/system_names.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

constexpr double kMillimetresPerInch = 25.4;

std::string motion_word(int motion) {
    if (motion == gcode::kNoMotion) { return "G80"; }
    return "G" + std::to_string(motion / 10) + (motion % 10 == 0 ? "" : "." + std::to_string(motion % 10));
}

std::string plane_word(gcode::Plane plane) {
    return plane == gcode::Plane::XY ? "G17" : plane == gcode::Plane::ZX ? "G18" : "G19";
}

std::string spindle_word(SpindleDirection spindle) {
    switch (spindle) {
        case SpindleDirection::Forward: return "M3";
        case SpindleDirection::Reverse: return "M4";
        case SpindleDirection::Stopped: break;
    }
    return "M5";
}

}  // namespace

std::vector<std::string> active_words(const gcode::State& state) {
    const gcode::Modal& modal = state.modal;
    std::vector<std::string> words{
        motion_word(modal.motion),      name_of_system(modal.system),
        plane_word(modal.plane),        modal.inches ? "G20" : "G21",
        modal.relative ? "G91" : "G90", modal.feed_mode == gcode::FeedMode::InverseTime ? "G93" : "G94",
        spindle_word(modal.spindle)};
    if (modal.mist) { words.emplace_back("M7"); }
    if (modal.flood) { words.emplace_back("M8"); }
    if (!modal.mist && !modal.flood) { words.emplace_back("M9"); }
    words.push_back("T" + std::to_string(state.selected_tool));
    words.push_back("F" + short_number(modal.inches ? modal.feed_linear / kMillimetresPerInch : modal.feed_linear));
    words.push_back("S" + short_number(modal.spindle_speed));
    return words;
}

}  // namespace lockstep
