// ProgramBuilder: what becomes of words that move nothing.
#include "core/gcode/program_builder.hpp"

namespace lockstep::gcode {

void ProgramBuilder::note(const std::string& kind, const std::string& text) {
    if (noted_.insert(kind).second) { notes_.push_back({line_, text}); }
}

void ProgramBuilder::unassigned(Unassigned rule, const std::string& what) {
    if (rule == Unassigned::Ignore || setup_.switches.ignore_unassigned) {
        return note(what, what + " is not configured: its words are passed over");
    }
    errors_.push_back(interpreter_->line().error(
        0, what + " is not configured on this machine; take the word out, or pass --ignore-unassigned"));
}

void ProgramBuilder::event(const Event& event) {
    const GcodeDevices& devices = setup_.devices;
    switch (event.kind) {
        case EventKind::Stop: return append(Pause{});
        case EventKind::OptionalStop:
            if (setup_.switches.pause_at_m1) { append(Pause{}); }
            return;
        case EventKind::ToolChange:
            notes_.push_back({line_, "tool change: put in tool " + std::to_string(event.index)});
            if (devices.pause_at_tool_change) { append(Pause{}); }
            return;
        case EventKind::SpindleSpeed:
        case EventKind::SpindleForward:
        case EventKind::SpindleReverse: return unassigned(devices.spindle, "the spindle");
        case EventKind::Mist:
        case EventKind::Flood: return unassigned(devices.coolant, "the coolant");
        case EventKind::OutputOn:
        case EventKind::OutputOff:
        case EventKind::AnalogOutput:
        case EventKind::InputWait: return unassigned(devices.outputs, "an output or input");
        case EventKind::Message: notes_.push_back({line_, "message: " + event.text}); return;
        case EventKind::Print: notes_.push_back({line_, "print: " + event.text}); return;
        default: return;
    }
}

}  // namespace lockstep::gcode
