// Finds which process received nothing from which other around an incident, and concludes which part of the network was
// cut.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

/// `observer` received nothing from `about`, although it ran itself.
struct Silence {
    FlightPeer observer;
    FlightPeer about;
    Tick from;
    Ticks lasts;  // as far as known
};

/// The silences that overlap the time from `from` to `to`, one of each pair (observer, about).
std::vector<Silence> silences(const Incident& incident, Tick from, Tick to);

/// The part of the network that was cut, if the silences have no other cause.
struct CutOff {
    std::optional<FlightPeer> who;  // cut off from all others; nullopt if one link was cut, or without a pattern
    Tick from;
    Ticks lasts;
    std::string text;  // "axis Y was cut off: it received no process, and no process received it"
};
/// Returns nullopt if there are no silences.
std::optional<CutOff> cut_off(const Incident& incident, const std::vector<Silence>& silences);

}  // namespace lockstep::incident
