#include "clients/text/event_text.hpp"

#include <fmt/format.h>

#include "core/number_text.hpp"

namespace lockstep {

std::string event_text(const ProgramEvent& event) {
    using Kind = ProgramEvent::Kind;
    const std::string speed = ", " + number_text(event.value) + " rev/min";
    switch (event.kind) {
        case Kind::SpindleStop: return "spindle stop";
        case Kind::SpindleForward: return "spindle forward" + speed;
        case Kind::SpindleReverse: return "spindle reverse" + speed;
        case Kind::SpindleSpeed: return "spindle speed" + speed;
        case Kind::CoolantOff: return "coolant off";
        case Kind::MistOn: return "mist on";
        case Kind::FloodOn: return "flood on";
        case Kind::OutputOn: return fmt::format("output {} on", event.index);
        case Kind::OutputOff: return fmt::format("output {} off", event.index);
        case Kind::AnalogOutput: return fmt::format("analog output {} to {}", event.index, number_text(event.value));
        case Kind::Tool:
            return event.index == 0 ? "no tool in the spindle" : fmt::format("tool {} in the spindle", event.index);
        case Kind::PulseSpacing:
            return fmt::format("pulses of output {} every {} mm", event.index, number_text(event.value));
        case Kind::PulsePlaces:
            return event.index == 0 ? "no more pulses"
                                    : fmt::format("{} pulses from {} mm on", event.index, number_text(event.value));
    }
    return "unknown";
}

std::string event_words(const ProgramEvent& event) {
    using Kind = ProgramEvent::Kind;
    const std::string value = number_text(event.value);
    switch (event.kind) {
        case Kind::SpindleStop: return "M5";
        case Kind::SpindleForward: return "M3 S" + value;
        case Kind::SpindleReverse: return "M4 S" + value;
        case Kind::SpindleSpeed: return "S" + value;
        case Kind::CoolantOff: return "M9";
        case Kind::MistOn: return "M7";
        case Kind::FloodOn: return "M8";
        case Kind::OutputOn: return fmt::format("M62 P{}", event.index);
        case Kind::OutputOff: return fmt::format("M63 P{}", event.index);
        case Kind::AnalogOutput: return fmt::format("M67 E{} Q{}", event.index, value);
        case Kind::Tool: return fmt::format("T{}", event.index);
        case Kind::PulseSpacing: return fmt::format("M69 P{} R{}", event.index, value);
        case Kind::PulsePlaces: return event.index == 0 ? "M69" : fmt::format("M69 Q{} L{}", value, event.index);
    }
    return "unknown";
}

}  // namespace lockstep
