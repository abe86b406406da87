// Which process did not receive which around an incident, and the conclusion about the network between them.
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
    Ticks lasts;  // as far as it is known
};

/// Those that overlap the time span, one of each pair.
std::vector<Silence> silences(const Incident& incident, Tick from, Tick to);

/// The cut part of the network, if the silences have no other cause.
struct CutOff {
    std::optional<FlightPeer> who;  // of one process to or from all others; nothing: one link, or no pattern
    Tick from;
    Ticks lasts;
    std::string text;  // "axis Y was cut off: it received no process, and no process received it"
};
/// Nothing if there are none.
std::optional<CutOff> cut_off(const Incident& incident, const std::vector<Silence>& silences);

}  // namespace lockstep::incident
