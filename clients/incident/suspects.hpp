// Explains the absence of a process, from its own notes and from those of others.
#pragma once

#include <optional>

#include "clients/incident/cause.hpp"

namespace lockstep::incident {

/// The time from sending a frame to its start, plus the length of a frame. Earlier events cannot affect the frame.
Ticks reach(const Incident& incident);

/// `at`: when another process missed a message of the suspect. Returns nullopt if the files show nothing wrong with it.
std::optional<Cause> explain(const Incident& incident, FlightPeer suspect, Tick at);

/// A cause in the network, outside of any process. Returns nullopt if the network was in order.
std::optional<Cause> explain_by_network(const Incident& incident, Tick at);

}  // namespace lockstep::incident
