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

}  // namespace lockstep
