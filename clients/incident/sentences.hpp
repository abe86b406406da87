// The notes of a process as text.
#pragma once

#include <string>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// Routine events belong to every frame, order and loop, or repeat another. Notable events belong to every job. Telling
/// events belong to a fault.
enum class Weight : std::uint8_t { Routine, Notable, Telling };
Weight weight_of(const Incident& incident, const Entry& entry);

/// "vetoes frame 17: no recent state of axis Y reports that it is held". The sentence does not name the note's process.
std::string sentence(const Incident& incident, const Entry& entry);

/// "axis X", "motor Y2", "the coordinator"
std::string peer_name(const Incident& incident, FlightPeer peer);
/// "axis X and axis Y"
std::string axes_named(const Incident& incident, MotorSet motors);
/// The end of a process without a request: "the process of axis X ended itself: failed check: ..."
std::string end_text(const Incident& incident, const Process& process);
/// "143 ms", "2.31 s", "0.4 ms"
std::string duration(double seconds);

}  // namespace lockstep::incident
