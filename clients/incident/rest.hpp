// Finds when a machine came to rest, from its axes' notes.
#pragma once

#include <optional>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// When the last of the axes that moved at `since` came to rest. Returns nullopt if none moved, or if not known.
std::optional<Tick> all_at_rest(const Incident& incident, Tick since);

}  // namespace lockstep::incident
