// One incident file, read as far as possible.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "services/flight/flight_messages.hpp"
#include "services/record/reading/damage.hpp"

namespace lockstep::incident {

struct FlightFile {
    std::filesystem::path path;
    FlightHead head;
    MachineConfig machine;  // as the process configured it
    std::vector<NumberedEvent> events;
    std::string note;  // why the process ended itself; empty if unknown
    std::vector<analysis::Damage> damages;
};

/// The error tells the user that the file is missing or not an incident file, and which file to give instead.
std::expected<FlightFile, std::string> read_flight_file(const std::filesystem::path& path);

}  // namespace lockstep::incident
