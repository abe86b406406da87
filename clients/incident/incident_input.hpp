// The incident files that a user names: by themselves, or by the directory that they are in.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep {

struct IncidentInput {
    std::vector<incident::Incident> incidents;  // the oldest first; at least one
    std::vector<std::string> left_out;          // files of a directory that are no incident files after all, and why
};

/// Error: what is named is not there, or holds no incident; files are of several machines.
std::expected<IncidentInput, std::string> read_incidents(const std::vector<std::filesystem::path>& named);

}  // namespace lockstep
