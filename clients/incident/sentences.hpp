// The notes of a process as text.
#pragma once

#include <string>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// Routine: of every frame, order and loop, or a repeat. Notable: of every job. Telling: of a fault.
enum class Weight : std::uint8_t { Routine, Notable, Telling };
Weight weight_of(const Incident& incident, const Entry& entry);

/// "vetoes frame 17: no recent state of axis Y reports that it is held". The process of the note is not named.
std::string sentence(const Incident& incident, const Entry& entry);

/// "axis X", "the coordinator"
std::string peer_name(const MachineConfig& machine, FlightPeer peer);
/// "axis X and axis Y"
std::string axes_named(const MachineConfig& machine, AxisSet axes);
/// The end of a process that was not asked to end: "the process of axis X ended itself: failed check: ..."
std::string end_text(const Incident& incident, const Process& process);
/// "143 ms", "2.31 s", "0.4 ms"
std::string duration(double seconds);

}  // namespace lockstep::incident
