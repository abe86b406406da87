// What a process has noted, as LCM messages and back: the only place that knows their types.
#pragma once

#include <cstdint>
#include <expected>
#include <lockstep/flight_event_t.hpp>
#include <lockstep/flight_head_t.hpp>
#include <lockstep/flight_note_t.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "services/flight/flight_source.hpp"

namespace lockstep {

inline constexpr std::int32_t kFlightVersion = 1;

/// Why what a process noted was written, and when it happened.
struct IncidentMark {
    IncidentReason reason = IncidentReason::Asked;
    Tick tick;                 // machine time
    std::int64_t wall_us = 0;  // since 1970, when it was written
    bool operator==(const IncidentMark&) const = default;
};

flight_head_t to_lcm(const FlightSource& source, const IncidentMark& mark);
/// `machine` names whom events are about.
flight_event_t to_lcm(const FlightSource& source, const MachineConfig& machine, const NumberedEvent& event);

/// `text`: why the process ended by itself.
flight_note_t to_lcm(const FlightSource& source, const IncidentMark& mark, const std::string& text);

struct FlightHead {
    FlightSource source;
    IncidentMark mark;
};
/// Error: of a version, or with a reason, that is not known here.
std::expected<FlightHead, std::string> from_lcm(const flight_head_t& message);
/// Error: of a kind that is not known here, or about nobody there is.
std::expected<NumberedEvent, std::string> from_lcm(const flight_event_t& message, const MachineConfig& machine);

/// As it stands in a ring.
std::vector<std::uint8_t> encode_source(const FlightSource& source);
std::expected<FlightSource, std::string> decode_source(std::span<const std::uint8_t> bytes);

}  // namespace lockstep
