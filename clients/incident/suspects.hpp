// Explains the absence of a process: from its own notes, and from those of others.
#pragma once

#include <optional>

#include "clients/incident/cause.hpp"

namespace lockstep::incident {

/// From when a frame is sent until it is decided, plus a frame: earlier events cannot affect a frame.
Ticks reach(const Incident& incident);

/// `at`: when another process missed its message. Nothing: nothing was wrong with it, as far as the files show.
std::optional<Cause> explain(const Incident& incident, FlightPeer suspect, Tick at);

/// A cause outside of any process. Nothing: the network was in order.
std::optional<Cause> explain_by_network(const Incident& incident, Tick at);

}  // namespace lockstep::incident
