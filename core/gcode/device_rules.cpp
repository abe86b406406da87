// ProgramBuilder: handles words that move no axis.
#include <charconv>
#include <utility>

#include "core/gcode/program_builder.hpp"
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
    const InputConfig* const input = event.is_analog ? nullptr : input_numbered(setup_.inputs, event.index);
    if (input == nullptr) {
        const std::string name = (event.is_analog ? "analog input " : "input ") + std::to_string(event.index);
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
    spindle_turns_ = coolant_flows_ = false;
}

void ProgramBuilder::event(const Event& event) {
    const UnassignedWords& rules = setup_.unassigned;
    const double speed = interpreter_->state().modal.spindle_speed;
    const AssignedWords& assigned = setup_.assigned;
    const auto spindle = [&](Kind kind) {
        spindle_turns_ = true;
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
            if (interpreter_->state().modal.spindle != Turning::Stopped) { spindle(Kind::SpindleSpeed); }
            return;
        case EventKind::SpindleForward: return spindle(Kind::SpindleForward);
        case EventKind::SpindleReverse: return spindle(Kind::SpindleReverse);
        case EventKind::SpindleStop: spindle_turns_ = false; return append(ProgramEvent{.kind = Kind::SpindleStop});
        case EventKind::Mist: return coolant(Kind::MistOn);
        case EventKind::Flood: return coolant(Kind::FloodOn);
        case EventKind::CoolantOff: coolant_flows_ = false; return append(ProgramEvent{.kind = Kind::CoolantOff});
        case EventKind::OutputOn: return output(Kind::OutputOn);
        case EventKind::OutputOff: return output(Kind::OutputOff);
        case EventKind::AnalogOutput: return output(Kind::AnalogOutput);
        case EventKind::InputWait: return wait_for_input(event);
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
