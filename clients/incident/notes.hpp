// Remarks on an incident in addition to the processes' notes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// "2026-11-21 10:01:36 UTC"
std::string wall_time(std::int64_t wall_us);

/// Sentences about the uncertainty of times, processes without a file, and parts that could not be read.
std::vector<std::string> notes_of(const Incident& incident);

}  // namespace lockstep::incident
