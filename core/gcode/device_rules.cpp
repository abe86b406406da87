// ProgramBuilder: handles words that move no axis.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/gcode/program_builder.hpp"
#include "core/gcode/run/context.hpp"
#include "core/number_text.hpp"

namespace lockstep::gcode {
namespace {

constexpr int kSpindleOverrideWord = 510;  // M51, in tenths

}  // namespace

using Kind = ProgramEvent::Kind;

void ProgramBuilder::note(const std::string& kind, const std::string& text) {
    if (noted_.insert(kind).second) { notes_.push_back({line_, text}); }
}

bool ProgramBuilder::is_refused(WordRule rule, const char* what, const char* key) {
    if (rule == WordRule::Ignore || setup_.switches.ignore_unassigned) { return false; }
    fail(std::string(what) +
         " is not configured on this machine; remove the word, pass --ignore-unassigned, or write unassigned { " + key +
         ": IGNORE } in the machine's file");
    return true;
}

void ProgramBuilder::device_event(WordRule rule, const char* what, const char* key, const ProgramEvent& event) {
    if (is_refused(rule, what, key)) { return; }
    note(what, std::string(what) + " is not configured: its words are published but switch nothing");
    append(event);
}

/// A loop may print without end.
void ProgramBuilder::note_message(const std::string& text) {
    constexpr std::size_t kMostNotes = 10'000;
    if (notes_.size() < kMostNotes) { return notes_.push_back({line_, text}); }
    note("more", "the program has more messages; only the first " + std::to_string(kMostNotes) + " are listed");
}

/// The text is the comment on the pause's line, otherwise the program's last message since the pause before, otherwise
/// the comment that names the tool.
void ProgramBuilder::pause(PauseReason reason, int tool) {
    Pause pause{.reason = reason, .tool = tool, .text = std::exchange(message_, {})};
    if (remark_line_ == line_ && !remark_.empty()) { pause.text = remark_; }
    const auto name = tool_names_.find(tool);
    const bool lacks_name = reason == PauseReason::ToolChange && pause.text.empty() && name != tool_names_.end();
    if (lacks_name) { pause.text = name->second; }
    append(std::move(pause));
}

/// Without a wait M66 would only set #5399, which programs cannot read.
void ProgramBuilder::wait_for_input(const Event& event) {
    if (event.is_analog) {
        return note("M66 E", "M66 E has no effect: it does not wait for the analog input, and #5399 cannot be read");
    }
    const InputConfig* const input = input_numbered(setup_.inputs, InputUse::Program, event.index);
    if (input == nullptr) {
        const std::string name = "input " + std::to_string(event.index);
        if (is_refused(setup_.unassigned.inputs, name.c_str(), "inputs")) { return; }
        return note(name, name + " is not configured: M66 is ignored");
    }
    if (event.mode == 0) { return note("M66 L0", "M66 L0 has no effect: it does not wait, and #5399 cannot be read"); }
    const auto mode = static_cast<InputMode>(event.mode - 1);
    const std::string until = "until " + input->name + " " + std::string(name_of(mode));
    append(Pause{.reason = PauseReason::Input,
                 .text = pause_text(until + ", at most " + number_text(event.value) + " s"),
                 .wait = InputWait{event.index, mode, event.value}});
}

/// Before a move with a feed the spindle comes to its speed.
void ProgramBuilder::await_speed(const decltype(lockstep::Block::action)& next) {
    const auto* move = std::get_if<ProgramMove>(&next);
    if (!awaits_speed_ || move == nullptr || move->rapid) { return; }
    awaits_speed_ = false;
    const GcodeSpinUp& spin_up = *setup_.spin_up;
    if (!spin_up.input) { return append(lockstep::Dwell{spin_up.seconds}); }
    const InputConfig* const input = input_numbered(setup_.inputs, InputUse::Program, *spin_up.input);
    const std::string sign = input == nullptr ? "" : " (input " + input->name + " closed)";
    append(Pause{.reason = PauseReason::Input,
                 .text = "until the spindle has its speed" + sign + ", at most " + number_text(spin_up.seconds) + " s",
                 .wait = InputWait{*spin_up.input, InputMode::IsClosed, spin_up.seconds}});
}

/// Lists of tools at the beginning of a program name each tool in a comment: (T2 6 mm end mill).
void ProgramBuilder::remark(const std::string& text) {
    remark_ = pause_text(text);
    remark_line_ = line_;
    if (remark_.size() < 2 || remark_[0] != 'T') { return; }
    int tool = 0;
    const char* const end = remark_.data() + remark_.size();
    const auto read = std::from_chars(remark_.data() + 1, end, tool);
    const std::size_t name = remark_.find_first_not_of(" :=-", static_cast<std::size_t>(read.ptr - remark_.data()));
    const bool has_name = read.ec == std::errc{} && name != remark_.npos && read.ptr != &remark_[name];
    if (has_name && tool_names_.size() < kMaxTools) { tool_names_.try_emplace(tool, remark_.substr(name)); }
}

void ProgramBuilder::change_tool(int tool) {
    note_message("tool change: put in tool " + std::to_string(tool));
    if (setup_.unassigned.tool_change == ToolChange::Pause) { pause(PauseReason::ToolChange, tool); }
    append(ProgramEvent{.kind = Kind::Tool, .index = tool});
}

/// Switches off the spindle and the coolant if the program leaves them on (RS274/NGC, 3.6.1).
void ProgramBuilder::end() {
    if (spindle_turns_) { append(ProgramEvent{.kind = Kind::SpindleStop}); }
    if (coolant_flows_) { append(ProgramEvent{.kind = Kind::CoolantOff}); }
    if (!setup_.pulses.empty()) { append(ProgramEvent{.kind = Kind::PulsePlaces}); }
    spindle_turns_ = coolant_flows_ = awaits_speed_ = false;
}

void ProgramBuilder::pulses(const Event& event) {
    const auto output = std::ranges::find(setup_.pulses, event.index, &GcodePulses::number);
    if (output != setup_.pulses.end()) {
        return event.mode == 0 ? append_pulses(event, 0, 0) : pulses_at(*output, event);
    }
    const std::string name = "output " + std::to_string(event.index) + " with use: PLACES";
    if (is_refused(setup_.unassigned.outputs, name.c_str(), "outputs")) { return; }
    note(name, name + " is not configured: M69 is ignored");
}

/// Checks the places of an output that counts steps.
void ProgramBuilder::pulses_at(const GcodePulses& output, const Event& event) {
    const GcodeAxis& axis = setup_.axes[output.axis];
    if (!places_[output.axis]) { return fail("M69 has no places of axis " + axis.name + ", which has no letter"); }
    const std::size_t letter = *places_[output.axis];
    const Offsets& offsets = interpreter_->state().offsets;
    const bool is_of_plane = letter < 2;
    if (is_of_plane && offsets.rotation != 0) {
        return fail("M69 needs a coordinate system that is not turned, because Q is a place of axis " + axis.name);
    }
    const bool in_inches = interpreter_->state().modal.inches && !is_turning(letter);
    const double unit_mm = in_inches ? Context::kMillimetresPerInch : 1;
    Point place = interpreter_->state().program;
    place[letter] = event.value * unit_mm;
    const double first_mm = to_machine(offsets, place)[letter];
    const double spacing_mm = event.spacing * unit_mm;
    const double last_mm = first_mm + spacing_mm * (event.mode - 1);
    (void)within_travel(output.axis, first_mm);
    (void)within_travel(output.axis, last_mm);
    const double steps = spacing_mm * output.steps_per_mm;
    constexpr double kHair_steps = 1e-3;
    if (std::abs(steps - std::round(steps)) > kHair_steps || std::round(steps) == 0) {
        const auto as_written = [&](double whole) { return number_text(whole / output.steps_per_mm / unit_mm); };
        return fail("R" + number_text(event.spacing) + " is " + number_text(steps) + " steps of axis " + axis.name +
                    "; places are a whole number of steps apart, such as R" + as_written(std::ceil(steps)) + " or R" +
                    as_written(std::floor(steps) == 0 ? -1 : std::floor(steps)));
    }
    if (std::abs(spacing_mm) < output.least_spacing_mm) {
        return fail("at the greatest speed of axis " + axis.name + " places " + number_text(std::abs(spacing_mm)) +
                    " mm apart come before the last pulse ends; R must be at least " +
                    number_text(output.least_spacing_mm / unit_mm) + ", or make pulse_us of the output shorter");
    }
    append_pulses(event, first_mm, spacing_mm);
}

void ProgramBuilder::append_pulses(const Event& event, double first_mm, double spacing_mm) {
    if (event.mode > 0) { append(ProgramEvent{.kind = Kind::PulseSpacing, .index = event.index, .value = spacing_mm}); }
    append(ProgramEvent{.kind = Kind::PulsePlaces, .index = event.mode, .value = first_mm});
}

void ProgramBuilder::event(const Event& event) {
    const UnassignedWords& rules = setup_.unassigned;
    const double speed = interpreter_->state().modal.spindle_speed;
    const AssignedWords& assigned = setup_.assigned;
    const auto spindle = [&](Kind kind) {
        spindle_turns_ = true;
        awaits_speed_ = setup_.spin_up.has_value();
        if (assigned.spindle) { return append(ProgramEvent{.kind = kind, .value = speed}); }
        device_event(rules.spindle, "the spindle", "spindle", {.kind = kind, .value = speed});
    };
    const auto coolant = [&](Kind kind) {
        coolant_flows_ = true;
        if (kind == Kind::MistOn ? assigned.mist : assigned.flood) { return append(ProgramEvent{.kind = kind}); }
        device_event(rules.coolant, "the coolant", "coolant", {.kind = kind});
    };
    const auto output = [&](Kind kind) {
        const ProgramEvent word{.kind = kind, .index = event.index, .value = event.value};
        const bool is_analog = kind == Kind::AnalogOutput;
        if (is_analog ? assigned.has_analog(event.index) : assigned.has_digital(event.index)) { return append(word); }
        const std::string name = (is_analog ? "analog output " : "output ") + std::to_string(event.index);
        device_event(rules.outputs, name.c_str(), "outputs", word);
    };
    switch (event.kind) {
        case EventKind::Stop: return pause(PauseReason::ProgramStop);
        case EventKind::PalletChange: return pause(PauseReason::PalletChange);
        case EventKind::OptionalStop:
            if (setup_.switches.pause_at_m1) { pause(PauseReason::OptionalStop); }
            return;
        case EventKind::End: return end();
        case EventKind::ToolChange: return change_tool(event.index);
        case EventKind::ToolNumber: return append(ProgramEvent{.kind = Kind::Tool, .index = event.index});
        case EventKind::SpindleSpeed:
            if (interpreter_->state().modal.spindle != SpindleDirection::Stopped) { spindle(Kind::SpindleSpeed); }
            return;
        case EventKind::SpindleForward: return spindle(Kind::SpindleForward);
        case EventKind::SpindleReverse: return spindle(Kind::SpindleReverse);
        case EventKind::SpindleStop:
            spindle_turns_ = awaits_speed_ = false;
            return append(ProgramEvent{.kind = Kind::SpindleStop});
        case EventKind::Mist: return coolant(Kind::MistOn);
        case EventKind::Flood: return coolant(Kind::FloodOn);
        case EventKind::CoolantOff: coolant_flows_ = false; return append(ProgramEvent{.kind = Kind::CoolantOff});
        case EventKind::Output: return output(event.switched);
        case EventKind::InputWait: return wait_for_input(event);
        case EventKind::Pulses: return pulses(event);
        case EventKind::SpeedOverride:  // also from M49, which has an effect on the feed
            if (event.value != 0 || interpreter_->block().code(Group::Override) != kSpindleOverrideWord) { return; }
            return note("M51", "M51 P0 has no effect: the machine has no spindle override");
        case EventKind::AdaptiveFeed:
            if (event.value == 0) { return; }
            return note("M52", "M52 P1 has no effect: the machine has no input for adaptive feed");
        case EventKind::FeedHold:
            if (event.value != 0) { return; }
            return note("M53", "M53 P0 has no effect: feed hold stays on");
        case EventKind::Message: message_ = pause_text(event.text); return note_message("message: " + event.text);
        case EventKind::Remark: return remark(event.text);
        case EventKind::Print: return note_message("print: " + event.text);
        default: return;
    }
}

}  // namespace lockstep::gcode
