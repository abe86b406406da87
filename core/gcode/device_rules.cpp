// ProgramBuilder: what becomes of words that move nothing.
#include "core/gcode/program_builder.hpp"

namespace lockstep::gcode {

void ProgramBuilder::note(const std::string& kind, const std::string& text) {
    if (noted_.insert(kind).second) { notes_.push_back({line_, text}); }
}

void ProgramBuilder::unassigned(WordRule rule, const std::string& what, const std::string& key) {
    if (rule == WordRule::Ignore || setup_.switches.ignore_unassigned) {
        return note(what, what + " is not configured: its words are passed over");
    }
    fail(what +
         " is not configured on this machine; take the word out, pass --ignore-unassigned, or write unassigned { " +
         key + ": IGNORE } in the machine's file");
}

void ProgramBuilder::event(const Event& event) {
    const UnassignedWords& rules = setup_.unassigned;
    switch (event.kind) {
        case EventKind::Stop: return append(Pause{});
        case EventKind::OptionalStop:
            if (setup_.switches.pause_at_m1) { append(Pause{}); }
            return;
        case EventKind::ToolChange:
            notes_.push_back({line_, "tool change: put in tool " + std::to_string(event.index)});
            return append(Pause{});
        case EventKind::SpindleSpeed:
        case EventKind::SpindleForward:
        case EventKind::SpindleReverse: return unassigned(rules.spindle, "the spindle", "spindle");
        case EventKind::Mist:
        case EventKind::Flood: return unassigned(rules.coolant, "the coolant", "coolant");
        case EventKind::OutputOn:
        case EventKind::OutputOff:
        case EventKind::AnalogOutput: return unassigned(rules.outputs, "an output", "outputs");
        case EventKind::InputWait: return unassigned(rules.inputs, "an input", "inputs");
        case EventKind::Message: notes_.push_back({line_, "message: " + event.text}); return;
        case EventKind::Print: notes_.push_back({line_, "print: " + event.text}); return;
        default: return;
    }
}

}  // namespace lockstep::gcode
