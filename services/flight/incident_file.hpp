// An incident file: one process's notes of the seconds before and after a fault, as an LCM log.
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/flight/flight_messages.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// How many seconds before the incident are written.
inline constexpr std::int64_t kFlightSeconds = 10;

/// Returns the first incident noted after event `after`; nullopt if there is none.
std::optional<NumberedEvent> first_incident(std::span<const NumberedEvent> events, std::uint64_t after);

/// Writes the snapshot into the source's directory, which it creates, and removes the oldest files of the same process
/// beyond the number kept. Returns the file. Error: the disk's error, and the remedy.
std::expected<std::filesystem::path, std::string> write_incident(const FlightSnapshot& snapshot,
                                                                 const IncidentMark& mark);

/// Returns the incident files in the directory, oldest first.
std::vector<std::filesystem::path> incident_files(const std::filesystem::path& directory);

/// Where this host's processes of the machine write their incident files.
std::filesystem::path incident_directory(const MachineSetup& machine);

/// Microseconds since 1970, by this host's clock.
std::int64_t wall_clock_us();

}  // namespace lockstep
