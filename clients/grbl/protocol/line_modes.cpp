#include "clients/grbl/protocol/line_modes.hpp"

#include <cstdio>
#include <variant>

#include "core/gcode/interpreter.hpp"

namespace lockstep::grbl {
namespace {

/// The place among kAxisLetters of an axis that G-code can name.
std::optional<std::size_t> letter_of(const AxisConfig& axis) {
    const std::size_t place = axis.name.size() == 1 ? gcode::kAxisLetters.find(axis.name[0]) : gcode::kAxisLetters.npos;
    return place == gcode::kAxisLetters.npos ? std::nullopt : std::optional(place);
}

gcode::Point park_of(const MachineConfig& machine) {
    gcode::Point park{};
    for (const AxisConfig& axis : machine.axes) {
        if (const auto letter = letter_of(axis)) { park[*letter] = axis.homing.park_mm; }
    }
    return park;
}

/// Whether the action only changes a mode, or ends a program that does nothing.
bool is_mode(const gcode::Action& action) {
    const auto* event = std::get_if<gcode::Event>(&action);
    if (event == nullptr) { return false; }
    switch (event->kind) {
        case gcode::EventKind::End:
        case gcode::EventKind::SpindleSpeed:
        case gcode::EventKind::SpindleStop:
        case gcode::EventKind::CoolantOff:
        case gcode::EventKind::PathMode:
        case gcode::EventKind::ToolSelect:
        case gcode::EventKind::Message: return true;
        default: return false;
    }
}

std::string motion_text(int motion) {
    if (motion < 0) { return "G80"; }
    return "G" + std::to_string(motion / 10) + (motion % 10 == 0 ? "" : "." + std::to_string(motion % 10));
}

std::string system_text(std::size_t system) {
    return system < 6 ? "G" + std::to_string(54 + system) : "G59." + std::to_string(system - 5);
}

std::string number(double value) {
    char text[400];
    std::snprintf(text, sizeof text, "%.0f", value);
    return text;
}

}  // namespace

LineModes::LineModes(const MachineConfig& machine) : machine_(machine) {
    for (const AxisConfig& axis : machine.axes) {
        if (letter_of(axis)) { letters_ += axis.name; }
    }
    reset();
}

void LineModes::reset() {
    modal_ = {};
    modal_.motion = 0;  // grbl begins with G0
}

gcode::State LineModes::state_of(const MachineView& view) const {
    gcode::State state;
    state.modal = modal_;
    for (std::size_t i = 0; i < machine_.axes.size() && i < view.axes.size(); ++i) {
        if (const auto letter = letter_of(machine_.axes[i])) { state.machine[*letter] = view.axes[i].mm; }
    }
    gcode::set_kept_values(state, view.values, park_of(machine_));
    gcode::begin(state);
    if (modal_.system != 0) { gcode::begin_system(state, modal_.system); }
    return state;
}

std::expected<LineEffect, Refused> LineModes::take(std::string_view line, const MachineView& view) {
    const gcode::State before = state_of(view);
    LineEffect effect;
    const auto note = [&effect](const gcode::Action& action, int) {
        effect.moves = effect.moves || !is_mode(action);
        const auto* event = std::get_if<gcode::Event>(&action);
        effect.ends_program = effect.ends_program || (event != nullptr && event->kind == gcode::EventKind::End);
    };
    gcode::Setup setup;
    setup.axes = letters_;
    gcode::Interpreter interpreter(setup, before, note);
    if (const auto taken = interpreter.take(line, 1); !taken) {
        return std::unexpected(Refused{Error::Unsupported, taken.error().message});
    }
    if (const auto closed = interpreter.finish(); !closed) {
        return std::unexpected(Refused{Error::Unsupported, closed.error().message});
    }
    const gcode::State& after = interpreter.state();
    if (effect.moves) { return effect; }
    if (effect.ends_program) {
        reset();
    } else {
        modal_ = after.modal;
    }
    const gcode::KeptValues values = gcode::kept_values(after, park_of(machine_));
    if (!(values == gcode::kept_values(before, park_of(machine_)))) { effect.values = values; }
    return effect;
}

std::string LineModes::modes_text() const {
    constexpr const char* kPlanes[] = {"G17", "G18", "G19"};
    const double feed = modal_.inches ? modal_.feed_linear / 25.4 : modal_.feed_linear;
    return motion_text(modal_.motion) + " " + system_text(modal_.system) + " " +
           kPlanes[static_cast<std::size_t>(modal_.plane)] + (modal_.inches ? " G20" : " G21") +
           (modal_.relative ? " G91" : " G90") + (modal_.feed_mode == gcode::FeedMode::InverseTime ? " G93" : " G94") +
           " M5 M9 T0 F" + number(feed) + " S" + number(modal_.spindle_speed);
}

std::vector<double> LineModes::offset_mm(const gcode::KeptValues& values) const {
    MachineView view;
    view.values = values;
    const gcode::Point zero = gcode::to_machine(state_of(view).offsets, {});
    std::vector<double> offset;
    for (const AxisConfig& axis : machine_.axes) {
        const auto letter = letter_of(axis);
        offset.push_back(letter ? zero[*letter] : 0);
    }
    return offset;
}

}  // namespace lockstep::grbl
