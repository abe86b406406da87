#include "core/flight/flight_event.hpp"

#include <algorithm>
#include <iterator>

#include "core/enumeration.hpp"

namespace lockstep {
namespace {

constexpr std::string_view kKinds[] = {
#define X(name, text) text,
    LOCKSTEP_FLIGHT_KINDS(X)
#undef X
};
constexpr std::string_view kReasons[] = {"fault",      "veto",     "interrupted", "axis-lost",
                                         "owner-lost", "takeover", "asked",       "ended"};

template <typename Enum>
std::optional<Enum> find(const auto& names, std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == std::end(names)) { return std::nullopt; }
    return static_cast<Enum>(found - std::begin(names));
}

}  // namespace

std::string_view name_of(FlightKind kind) { return pick_name(kKinds, kind); }
std::optional<FlightKind> flight_kind(std::string_view name) { return find<FlightKind>(kKinds, name); }
std::string_view name_of(IncidentReason reason) { return pick_name(kReasons, reason); }
std::optional<IncidentReason> incident_reason(std::string_view name) { return find<IncidentReason>(kReasons, name); }

}  // namespace lockstep
