#include "core/flight/flight_event.hpp"

#include <algorithm>
#include <array>

namespace lockstep {
namespace {

constexpr auto kKinds = std::to_array<std::string_view>({
#define X(name, text) text,
    LOCKSTEP_FLIGHT_KINDS(X)
#undef X
});
constexpr std::array<std::string_view, static_cast<std::size_t>(IncidentReason::Ended) + 1> kReasons{
    "fault", "veto", "interrupted", "axis-lost", "owner-lost", "takeover", "asked", "ended"};

template <typename Enum>
std::string_view pick(const auto& names, Enum value) {
    const auto i = static_cast<std::size_t>(value);
    return i < names.size() ? names[i] : "unknown";
}

template <typename Enum>
std::optional<Enum> find(const auto& names, std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) { return std::nullopt; }
    return static_cast<Enum>(found - names.begin());
}

}  // namespace

std::string_view name_of(FlightKind kind) { return pick(kKinds, kind); }
std::optional<FlightKind> flight_kind(std::string_view name) { return find<FlightKind>(kKinds, name); }
std::string_view name_of(IncidentReason reason) { return pick(kReasons, reason); }
std::optional<IncidentReason> incident_reason(std::string_view name) { return find<IncidentReason>(kReasons, name); }

}  // namespace lockstep
