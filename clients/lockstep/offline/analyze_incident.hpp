// lockstep analyze --incident: evaluates the flight recorder notes of a machine's processes about a fault.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "clients/text/exit_code.hpp"

namespace lockstep {

struct IncidentOptions {
    std::vector<std::filesystem::path> incidents;  // files and directories
    std::optional<std::filesystem::path> log;      // of the run, for the page's curves
    int back = 0;                                  // 0: the newest incident, 1: the one before it
    bool all = false;                              // also routine events
    std::optional<std::filesystem::path> html;     // default: beside the incident files
    bool no_html = false;
    bool json = false;
    bool no_colour = false;
};

/// Splits the paths of --incident. The log is the first path that is neither a directory nor named like an incident
/// file, unless it is the only path.
IncidentOptions split_paths(const std::vector<std::string>& paths);

ExitCode analyze_incident(const IncidentOptions& options);

}  // namespace lockstep
