// When a machine came to rest, by what its axes noted.
#pragma once

#include <optional>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// When the last of the axes that moved at `since` did. Nothing: none moved, or it is not known of any.
std::optional<Tick> all_at_rest(const Incident& incident, Tick since);

}  // namespace lockstep::incident
