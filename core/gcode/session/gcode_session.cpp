#include "core/gcode/session/gcode_session.hpp"

#include <utility>

#include "core/gcode/interpreter.hpp"
#include "core/gcode/program_builder.hpp"

namespace lockstep {
namespace {

using gcode::State;

std::vector<double> end_of(const std::vector<Block>& blocks, std::vector<double> place_mm) {
    for (const Block& block : blocks) {
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) { place_mm = move->target_mm; }
    }
    return place_mm;
}

GcodeError needs_lines(const std::string& what) {
    return {1, 1, what + " needs the lines that follow it; write them all into a file, and run the file"};
}

/// One line on its way through an interpreter.
class Reading {
public:
    /// `message`: the last one before, for the next pause.
    Reading(const GcodeSetup& setup, gcode::Memory before, const std::string& message, bool awaits_speed)
        : builder_(setup),
          interpreter_(gcode::interpreter_setup(setup), std::move(before),
                       [this](const gcode::Action& action, int line) { take(action, line); }) {
        builder_.begin(interpreter_.state().modal, message, awaits_speed);
    }

    std::expected<SessionLine, GcodeError> read(std::string_view line) {
        const auto taken = interpreter_.take(line, 1);
        if (const auto errors = builder_.take_errors(); !errors.empty()) { return std::unexpected(errors.front()); }
        if (!taken) { return std::unexpected(taken.error()); }
        if (auto slow = gcode::slow_feed(interpreter_)) { return std::unexpected(*std::move(slow)); }
        if (const auto open = interpreter_.open_word()) { return std::unexpected(needs_lines(*open)); }
        if (interpreter_.state().modal.side != gcode::Side::None) {
            return std::unexpected(needs_lines("cutter compensation"));
        }
        if (interpreter_.awaits_touch() && interpreter_.is_within_body()) {
            return std::unexpected(
                GcodeError{1, 1, "a subroutine that probes runs from a file only; write it into a file"});
        }
        return SessionLine{.head = builder_.head(),
                           .blocks = builder_.blocks().take(),
                           .notes = builder_.take_notes(),
                           .place_mm = {},
                           .values = {},
                           .changes_values = false,
                           .ends_program = ends_program_,
                           .awaits_touch = interpreter_.awaits_touch(),
                           .message = builder_.message(),
                           .awaits_speed = builder_.awaits_speed(),
                           .after = interpreter_.memory()};
    }

private:
    void take(const gcode::Action& action, int line) {
        const auto* event = std::get_if<gcode::Event>(&action);
        ends_program_ = ends_program_ || (event != nullptr && event->kind == gcode::EventKind::End);
        builder_.take(action, line, interpreter_);
    }

    gcode::ProgramBuilder builder_;
    gcode::Interpreter interpreter_;
    bool ends_program_ = false;
};

}  // namespace

GcodeSession::GcodeSession(GcodeSetup setup, const MachineConfig& machine, int first_motion)
    : setup_(std::move(setup)), machine_(machine), first_motion_(first_motion), park_(gcode::park_place(setup_)) {
    setup_.awaits_touches = true;
    reset();
}

void GcodeSession::reset() {
    memory_ = {};
    message_.clear();
    awaits_speed_ = false;
    place_mm_.reset();
    values_.reset();
    end_program();
}

void GcodeSession::end_program() {
    State& state = memory_.state;
    state.modal = {.motion = first_motion_};
    state.offsets.tool = {};
    state.cycle = {};
    state.spline = {};
    memory_.kept = {};
    gcode::begin_system(state, 0);
}

/// Offsets that the session itself has changed are in force as it left them: G10 L2, for example, changes the chosen
/// system at once, but an assignment to its parameters holds only from the next G54. Other values come from elsewhere.
gcode::Memory GcodeSession::memory_at(const gcode::KeptValues& values) const {
    gcode::Memory memory = memory_;
    if (values_ == values) { return memory; }
    State& state = memory.state;
    gcode::set_kept_values(state, values, park_);
    state.parameters.numbered[gcode::kSystemParameter] = static_cast<double>(state.modal.system + 1);
    gcode::begin(state);
    return memory;
}

/// Returns the exact place of each axis. At rest an axis is known only to a whole step. While it is still at the step
/// where the last line ended, the exact end of that line holds, so that distances below a step add up.
std::vector<double> GcodeSession::begin_at(const std::vector<double>& place_mm, State& state) const {
    std::vector<double> exact_mm = place_mm;
    bool has_moved = false;
    for (std::size_t i = 0; i < place_mm.size(); ++i) {
        const AxisConfig& axis = machine_.axes[i];
        if (place_mm_ && to_steps(axis, (*place_mm_)[i]) == to_steps(axis, place_mm[i])) {
            exact_mm[i] = (*place_mm_)[i];
            continue;
        }
        has_moved = true;
        if (const auto letter = gcode::axis_place(axis.name)) { state.machine[*letter] = place_mm[i]; }
    }
    if (has_moved) { state.program = gcode::to_program(state.offsets, state.machine); }
    return exact_mm;
}

std::expected<SessionLine, GcodeError> GcodeSession::read(std::string_view line, const SessionStart& start) const {
    gcode::Memory before = memory_at(start.values);
    const std::vector<double> from_mm = begin_at(start.place_mm, before.state);
    GcodeSetup setup = setup_;
    for (std::size_t i = 0; i < setup.axes.size(); ++i) { setup.axes[i].start_mm = from_mm[i]; }
    const gcode::KeptValues values = gcode::kept_values(before.state, park_);
    auto read = Reading(setup, std::move(before), message_, awaits_speed_).read(line);
    if (!read) { return read; }
    read->place_mm = end_of(read->blocks, from_mm);
    gcode::KeptValues after = gcode::kept_values(read->after.state, park_);
    read->changes_values = after != values;
    read->values = read->changes_values ? std::move(after) : start.values;
    return read;
}

void GcodeSession::commit(SessionLine& line) {
    memory_ = std::move(line.after);
    message_ = line.message;
    awaits_speed_ = line.awaits_speed;
    place_mm_ = line.place_mm;
    values_ = line.values;
    if (line.ends_program) { end_program(); }
}

/// An axis at the step where the move would end keeps its exact place.
void GcodeSession::touched(const ProbeTouch& touch) {
    State& state = memory_.state;
    gcode::Touch known{.touched = touch.touched, .at = state.machine, .rest = state.machine};
    for (std::size_t i = 0; i < machine_.axes.size(); ++i) {
        const AxisConfig& axis = machine_.axes[i];
        const auto letter = gcode::axis_place(axis.name);
        if (!letter || to_steps(axis, state.machine[*letter]) == to_steps(axis, touch.rest_mm[i])) { continue; }
        known.at[*letter] = touch.places_mm[i];
        known.rest[*letter] = touch.rest_mm[i];
        if (place_mm_) { (*place_mm_)[i] = touch.rest_mm[i]; }
    }
    gcode::note_touch(state, known);
}

void GcodeSession::set_devices(const ProgramDevices& devices) {
    gcode::Modal& modal = memory_.state.modal;
    modal.spindle = devices.spindle;
    modal.mist = devices.mist;
    modal.flood = devices.flood;
}

gcode::Offsets GcodeSession::offsets(const gcode::KeptValues& values) const {
    return values_ == values ? memory_.state.offsets : memory_at(values).state.offsets;
}

}  // namespace lockstep
