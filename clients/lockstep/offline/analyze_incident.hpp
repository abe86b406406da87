// lockstep analyze --incident: the notes of the flight recorders of a machine's processes about a fault.
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
    int back = 0;                                  // so many incidents before the newest
    bool all = false;                              // also routine events
    std::optional<std::filesystem::path> html;     // nothing: beside the incident files
    bool no_html = false;
    bool json = false;
    bool no_colour = false;
};

/// Splits the paths of --incident: the log is the one that is not a directory and not named like an incident file,
/// unless it is the only one.
IncidentOptions split_paths(const std::vector<std::string>& paths);

ExitCode analyze_incident(const IncidentOptions& options);

}  // namespace lockstep
