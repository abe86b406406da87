#include "clients/grbl/protocol/gcode_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <variant>

#include "clients/grbl/protocol/number.hpp"
#include "core/arc_path.hpp"
#include "core/gcode/interpreter.hpp"
#include "core/gcode/program_builder.hpp"
#include "core/if_positive.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep::grbl {
namespace {

gcode::Point park_of(const MachineConfig& machine) {
    gcode::Point park{};
    for (const AxisConfig& axis : machine.axes) {
        if (const auto letter = gcode::axis_place(axis.name)) { park[*letter] = axis.homing.park_mm; }
    }
    return park;
}

bool comes_to_rest(const Block& block) {
    const auto* move = std::get_if<ProgramMove>(&block.action);
    if (move != nullptr) { return move->mode == PathMode::ExactStop; }
    return !std::holds_alternative<ProgramEvent>(block.action);
}

/// Whether the action adds nothing to run and no event.
bool is_without_effect(const gcode::Action& action) {
    const auto* event = std::get_if<gcode::Event>(&action);
    if (event == nullptr) { return false; }
    switch (event->kind) {
        case gcode::EventKind::PathMode:
        case gcode::EventKind::ToolSelect: return true;
        default: return false;
    }
}

/// The N word, after blanks and a slash; nullopt without one or if it does not fit 32 bits.
std::optional<std::int32_t> sender_line_of(std::string_view line) {
    const std::size_t begin = line.find_first_not_of(" \t/");
    if (begin == line.npos || (line[begin] != 'N' && line[begin] != 'n')) { return std::nullopt; }
    std::int32_t number = 0;
    const auto read = std::from_chars(line.data() + begin + 1, line.data() + line.size(), number);
    return read.ec == std::errc{} ? if_positive(number) : std::nullopt;
}

Refused refused(const GcodeError& error) { return {error_of(error.message), error.message}; }

std::string motion_text(int motion) {
    if (motion < 0) { return "G80"; }
    return motion % 10 == 0 ? fmt::format("G{}", motion / 10) : fmt::format("G{}.{}", motion / 10, motion % 10);
}

std::string system_text(std::size_t system) {
    return system < 6 ? fmt::format("G{}", 54 + system) : fmt::format("G59.{}", system - 5);
}

std::string spindle_text(gcode::Turning spindle) {
    switch (spindle) {
        case gcode::Turning::Forward: return " M3";
        case gcode::Turning::Reverse: return " M4";
        case gcode::Turning::Stopped: break;
    }
    return " M5";
}

std::string coolant_text(const gcode::Modal& modal) {
    if (!modal.mist && !modal.flood) { return " M9"; }
    return std::string(modal.mist ? " M7" : "") + (modal.flood ? " M8" : "");
}

}  // namespace

GcodeLines::GcodeLines(const MachineConfig& machine)
    : machine_(machine), setup_(gcode_setup(machine, std::vector<double>(machine.axes.size()), "lines of a sender")) {
    reset();
}

void GcodeLines::reset() {
    modal_ = {};
    modal_.motion = 0;  // grbl begins with G0
    tool_offset_ = {};
    selected_tool_ = tool_ = 0;
}

/// The end of a program resets all modes except the tools.
void GcodeLines::commit(const LineEffect& effect) {
    reset();
    selected_tool_ = effect.selected_tool;
    tool_ = effect.tool;
    if (effect.ends_program) { return; }
    modal_ = effect.modal;
    tool_offset_ = effect.tool_offset;
}

bool GcodeLines::switch_off() {
    const bool was_on = modal_.spindle != gcode::Turning::Stopped || modal_.mist || modal_.flood;
    modal_.spindle = gcode::Turning::Stopped;
    modal_.mist = modal_.flood = false;
    return was_on;
}

gcode::State GcodeLines::state_at(const std::vector<double>& place_mm, const gcode::KeptValues& values) const {
    gcode::State state;
    state.modal = modal_;
    for (std::size_t i = 0; i < machine_.axes.size() && i < place_mm.size(); ++i) {
        if (const auto letter = gcode::axis_place(machine_.axes[i].name)) { state.machine[*letter] = place_mm[i]; }
    }
    gcode::set_kept_values(state, values, park_of(machine_));
    gcode::begin(state);
    state.offsets.tool = tool_offset_;
    gcode::begin_system(state, modal_.system);
    state.selected_tool = selected_tool_;
    state.tool = tool_;
    return state;
}

std::expected<LineEffect, Refused> GcodeLines::read(std::string_view line, const std::vector<double>& place_mm,
                                                    const gcode::KeptValues& values) const {
    const gcode::State before = state_at(place_mm, values);
    GcodeSetup setup = setup_;
    setup.values = values;
    for (std::size_t i = 0; i < setup.axes.size() && i < place_mm.size(); ++i) { setup.axes[i].start_mm = place_mm[i]; }
    gcode::ProgramBuilder builder(setup);
    LineEffect effect;
    builder.begin(before.modal);
    gcode::Interpreter* reading = nullptr;
    const auto take = [&](const gcode::Action& action, int) {
        const auto* event = std::get_if<gcode::Event>(&action);
        effect.ends_program = effect.ends_program || (event != nullptr && event->kind == gcode::EventKind::End);
        if (!is_without_effect(action)) { builder.take(action, 1, *reading); }
    };
    gcode::Interpreter interpreter(gcode::interpreter_setup(setup), before, take);
    reading = &interpreter;
    const auto taken = interpreter.take(line, 1);
    if (const auto errors = builder.take_errors(); !errors.empty()) { return std::unexpected(refused(errors.front())); }
    if (!taken) { return std::unexpected(refused(taken.error())); }
    if (const auto slow = gcode::slow_feed(interpreter)) { return std::unexpected(refused(*slow)); }
    if (const auto closed = interpreter.finish(); !closed) { return std::unexpected(refused(closed.error())); }
    const gcode::State& after = interpreter.state();
    if (after.modal.side != gcode::Side::None) {
        return std::unexpected(Refused{Error::Unsupported,
                                       "cutter compensation needs the lines that follow; run a "
                                       "file: lockstep run FILE"});
    }
    effect.modal = after.modal;
    effect.tool_offset = after.offsets.tool;
    effect.selected_tool = after.selected_tool;
    effect.tool = after.tool;
    effect.sender_line = sender_line_of(line);
    effect.blocks = builder.take_blocks();
    for (GcodeNote& note : builder.take_notes()) { effect.notes.push_back(std::move(note.text)); }
    effect.place_mm = place_mm;
    for (const Block& block : effect.blocks) {
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) { effect.place_mm = move->target_mm; }
        effect.rests_behind = effect.rests_behind || comes_to_rest(block);
    }
    effect.seconds = seconds_of(effect.blocks, place_mm);
    const gcode::KeptValues left = gcode::kept_values(after, park_of(machine_));
    if (!(left == gcode::kept_values(before, park_of(machine_)))) { effect.values = left; }
    if (effect.values && !effect.blocks.empty()) {
        return std::unexpected(Refused{Error::TwoAxisCommands, "a line that sets offsets cannot also move axes"});
    }
    effect.rests_before = effect.values || effect.ends_program || modal_.system != effect.modal.system ||
                          tool_offset_ != effect.tool_offset;
    return effect;
}

/// The duration at the feed, or at the axes' maximum velocity if that is slower, without ramps.
double GcodeLines::seconds_of(const std::vector<Block>& blocks, const std::vector<double>& from_mm) const {
    double seconds = 0;
    std::vector<double> at = from_mm;
    for (const Block& block : blocks) {
        if (const auto* dwell = std::get_if<Dwell>(&block.action)) { seconds += dwell->seconds; }
        const auto* move = std::get_if<ProgramMove>(&block.action);
        if (move == nullptr) { continue; }
        double least = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const double way = std::abs(move->target_mm[i] - at[i]);
            least = std::max(least, way / machine_.axes[i].max_velocity_mm_s);
        }
        seconds += move->rapid ? least : std::max(least, length_mm(*move, at) / move->feed_mm_s);
        at = move->target_mm;
    }
    return seconds;
}

std::string GcodeLines::modes_text() const {
    constexpr const char* kPlanes[] = {"G17", "G18", "G19"};
    const double feed = modal_.inches ? modal_.feed_linear / 25.4 : modal_.feed_linear;
    return fmt::format("{} {} {} {} {} {}{}{} T{} F{} S{}", motion_text(modal_.motion), system_text(modal_.system),
                       kPlanes[static_cast<std::size_t>(modal_.plane)], modal_.inches ? "G20" : "G21",
                       modal_.relative ? "G91" : "G90",
                       modal_.feed_mode == gcode::FeedMode::InverseTime ? "G93" : "G94", spindle_text(modal_.spindle),
                       coolant_text(modal_), selected_tool_, number(feed, 0), number(modal_.spindle_speed, 0));
}

std::vector<double> GcodeLines::offset_mm(const gcode::KeptValues& values) const {
    const gcode::Point zero = gcode::to_machine(state_at({}, values).offsets, {});
    std::vector<double> offset;
    for (const AxisConfig& axis : machine_.axes) {
        const auto letter = gcode::axis_place(axis.name);
        offset.push_back(letter ? zero[*letter] : 0);
    }
    return offset;
}

}  // namespace lockstep::grbl
