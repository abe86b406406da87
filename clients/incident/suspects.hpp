// Why a process did not do its part: by what it noted itself, and by what others did.
#pragma once

#include <optional>

#include "clients/incident/cause.hpp"

namespace lockstep::incident {

/// From when a frame is sent until it is decided, and a frame more: what is earlier has no part in a frame's fate.
Ticks reach(const Incident& incident);

/// `at`: when another process missed its word. Nothing: nothing was wrong with it, as far as the files tell.
std::optional<Cause> explain(const Incident& incident, FlightPeer suspect, Tick at);

/// What no process can be blamed for. Nothing: the network was well.
std::optional<Cause> explain_by_network(const Incident& incident, Tick at);

}  // namespace lockstep::incident
