// Separates the incidents that the same notes contain.
//
// A later note of an incident (FlightKind::Incident) is a new incident if the machine continued in between:
// - it was in Fault and then in Idle or in a job again; or
// - it began a job or an epoch, or became Idle, and the notes are further apart than the time in which all processes
//   notice one fault. In a shorter time the coordinator may begin a motion before it knows of the fault.
#pragma once

#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// The times at which one incident is over and the notes of the next begin, in order. Empty if there is at most one
/// incident. `all`: all notes of one stretch of machine time.
std::vector<Tick> boundaries(const Incident& all);

}  // namespace lockstep::incident
