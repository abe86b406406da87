// Who did not hear whom around an incident, and what that says of the network between them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// `observer` heard nothing of `about`, which was not because it did not run itself.
struct Silence {
    FlightPeer observer;
    FlightPeer about;
    Tick from;
    Ticks lasts;  // as far as it is known
};

/// Those that touch the stretch of time, one of each pair.
std::vector<Silence> silences(const Incident& incident, Tick from, Tick to);

/// What was cut, if these are due to the network alone.
struct CutOff {
    std::optional<FlightPeer> who;  // of one process to or from all others; nothing: one link, or no pattern
    Tick from;
    Ticks lasts;
    std::string text;  // "axis Y was cut off: it heard nobody, and nobody heard it"
};
/// Nothing where there are none.
std::optional<CutOff> cut_off(const Incident& incident, const std::vector<Silence>& silences);

}  // namespace lockstep::incident
