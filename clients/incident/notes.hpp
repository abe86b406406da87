// What is to be known of an incident besides what was noted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// "2026-11-21 10:01:36 UTC"
std::string wall_time(std::int64_t wall_us);

/// A sentence each: within what times are known, processes without a file, what could not be read.
std::vector<std::string> notes_of(const Incident& incident);

}  // namespace lockstep::incident
