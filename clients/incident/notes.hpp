// Remarks on an incident besides the notes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// "2026-11-21 10:01:36 UTC"
std::string wall_time(std::int64_t wall_us);

/// A sentence each: the uncertainty of times, processes without a file, parts that could not be read.
std::vector<std::string> notes_of(const Incident& incident);

}  // namespace lockstep::incident
