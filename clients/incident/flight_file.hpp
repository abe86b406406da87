// One incident file, read as far as possible.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/analysis/log/damage.hpp"
#include "services/flight/flight_messages.hpp"

namespace lockstep::incident {

struct FlightFile {
    std::filesystem::path path;
    FlightHead head;
    MachineConfig machine;  // as its process had it
    std::vector<NumberedEvent> events;
    std::string note;  // why its process ended itself; empty: unknown
    std::vector<analysis::Damage> damages;
};

/// Error, for the user: the file is missing or not an incident file, and what to give instead.
std::expected<FlightFile, std::string> read_flight_file(const std::filesystem::path& path);

}  // namespace lockstep::incident
