// Translates a process's notes to LCM messages and back. No other file uses these message types.
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

/// Why a process's notes were written, and when the incident happened.
struct IncidentMark {
    IncidentReason reason = IncidentReason::Asked;
    Tick tick;                 // machine time
    std::int64_t wall_us = 0;  // when the file was written, since 1970
    bool operator==(const IncidentMark&) const = default;
};

flight_head_t to_lcm(const FlightSource& source, const IncidentMark& mark);
/// `machine` provides the names of the axes that events refer to.
flight_event_t to_lcm(const FlightSource& source, const MachineConfig& machine, const NumberedEvent& event);

/// `text` says why the process ended itself.
flight_note_t to_lcm(const FlightSource& source, const IncidentMark& mark, const std::string& text);

struct FlightHead {
    FlightSource source;
    IncidentMark mark;
};
/// Error: an unknown version or reason, or an invalid process name.
std::expected<FlightHead, std::string> from_lcm(const flight_head_t& message);
/// Error: an unknown kind or fault, or an event about an axis that the machine does not have.
std::expected<NumberedEvent, std::string> from_lcm(const flight_event_t& message, const MachineConfig& machine);

/// Encodes the source for storage in a ring.
std::vector<std::uint8_t> encode_source(const FlightSource& source);
std::expected<FlightSource, std::string> decode_source(std::span<const std::uint8_t> bytes);

}  // namespace lockstep
