// Reads the incident files that a user names, singly or by their directory.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep {

struct IncidentInput {
    std::vector<incident::Incident> incidents;  // the oldest first; at least one
    std::vector<std::string> left_out;          // files of a directory that are not incident files, and why
};

/// Fails if a named file does not exist or holds no incident, or if the files are of several machines.
std::expected<IncidentInput, std::string> read_incidents(const std::vector<std::filesystem::path>& named);

}  // namespace lockstep
