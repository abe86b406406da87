// What a process noted, in words.
#pragma once

#include <string>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// Routine: of every frame, order and loop, or said again. Notable: of every job. Telling: of a fault.
enum class Weight : std::uint8_t { Routine, Notable, Telling };
Weight weight_of(const Incident& incident, const Entry& entry);

/// "vetoes frame 17: nothing fresh from axis Y says that it holds it". The process that says it is not named.
std::string sentence(const Incident& incident, const Entry& entry);

/// "axis X", "the coordinator"
std::string peer_name(const MachineConfig& machine, FlightPeer peer);
/// "axis X and axis Y"
std::string axes_named(const MachineConfig& machine, AxisSet axes);
/// How a process ended that nobody had asked to: "the process of axis X ended by itself: failed check: ..."
std::string end_text(const Incident& incident, const Process& process);
/// "143 ms", "2.31 s", "0.4 ms"
std::string duration(double seconds);

}  // namespace lockstep::incident
