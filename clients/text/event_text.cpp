#include "clients/text/event_text.hpp"

#include "core/number_text.hpp"

namespace lockstep {

std::string event_text(const ProgramEvent& event) {
    using Kind = ProgramEvent::Kind;
    const std::string speed = ", " + number_text(event.value) + " rev/min";
    const std::string number = std::to_string(event.index);
    switch (event.kind) {
        case Kind::SpindleStop: return "spindle stop";
        case Kind::SpindleForward: return "spindle forward" + speed;
        case Kind::SpindleReverse: return "spindle reverse" + speed;
        case Kind::SpindleSpeed: return "spindle speed" + speed;
        case Kind::CoolantOff: return "coolant off";
        case Kind::MistOn: return "mist on";
        case Kind::FloodOn: return "flood on";
        case Kind::OutputOn: return "output " + number + " on";
        case Kind::OutputOff: return "output " + number + " off";
        case Kind::AnalogOutput: return "analog output " + number + " to " + number_text(event.value);
        case Kind::Tool: return event.index == 0 ? "no tool in the spindle" : "tool " + number + " in the spindle";
    }
    return "unknown";
}

}  // namespace lockstep
