#include "clients/text/event_text.hpp"

#include <fmt/format.h>

#include <string_view>

#include "core/enumeration.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

std::string filled(std::string_view text, const ProgramEvent& event) {
    return fmt::format(fmt::runtime(text), fmt::arg("index", event.index), fmt::arg("value", number_text(event.value)));
}

const EventWords& row_of(const ProgramEvent& event) { return pick_row(kEventWords, event.kind); }

}  // namespace

std::string event_text(const ProgramEvent& event) {
    using Kind = ProgramEvent::Kind;
    if (event.kind == Kind::Tool && event.index == 0) { return "no tool in the spindle"; }
    if (event.kind == Kind::PulsePlaces && event.index == 0) { return "no more pulses"; }
    return filled(row_of(event).text, event);
}

std::string event_words(const ProgramEvent& event) {
    if (event.kind == ProgramEvent::Kind::PulsePlaces && event.index == 0) { return "M69"; }
    return filled(row_of(event).words, event);
}

}  // namespace lockstep
