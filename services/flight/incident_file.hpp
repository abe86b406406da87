// An incident file: what one process noted in the last seconds before a fault and the first after it, as an LCM log.
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/flight/flight_messages.hpp"

namespace lockstep {

/// How much of what was before the incident is written.
inline constexpr std::int64_t kFlightSeconds = 10;

/// The first incident noted after event `after`; nothing where there is none.
std::optional<NumberedEvent> first_incident(std::span<const NumberedEvent> events, std::uint64_t after);

/// Writes it into the source's directory, which is made, and removes the oldest of the same process beyond as many as
/// are kept. Returns the file. Error: the disk's, and the remedy.
std::expected<std::filesystem::path, std::string> write_incident(const FlightSnapshot& snapshot,
                                                                 const IncidentMark& mark);

/// Incident files, the oldest first.
std::vector<std::filesystem::path> incident_files(const std::filesystem::path& directory);

/// Where this host's processes of the machine write theirs.
std::filesystem::path incident_directory(const MachineConfig& machine);

/// Microseconds since 1970, by this host's clock.
std::int64_t wall_clock_us();

}  // namespace lockstep
