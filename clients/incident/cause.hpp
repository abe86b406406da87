// What began an incident, as well as the processes' notes tell; who noticed it first; and how it ended.
//
// The first symptom names suspects: of an axis without evidence those it lacks, of a lost frame the coordinator, of a
// fault its axis. A suspect is explained by what itself and others noted: it ended, it stood still, it refused, it was
// cut off. Only a standstill longer than the machine's stall_slots can have had an effect, and only one that touches
// the time in which the frame in question was sent and decided.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

enum class CauseKind : std::uint8_t {
    Ended,          // a process did: killed, or crashed
    Stalled,        // a process stood still, and went on
    Hangs,          // a process stands still to this day
    HostStalled,    // several stood still at the same time
    CutOff,         // the network carried nothing of one process, or between two
    Fault,          // an axis or the machine noticed one in itself
    Refused,        // an axis refused a frame
    EmergencyStop,  // was commanded
    Asked,          // nothing was wrong: a person asked for what was noted
    Unknown         // the files do not tell
};
std::string_view name_of(CauseKind kind);

struct Cause {
    CauseKind kind = CauseKind::Unknown;
    std::optional<FlightPeer> who;  // nothing: no one process
    std::string text;               // a sentence without its stop
    std::optional<Tick> at;
    Ticks lasts;
};

struct Verdict {
    Cause cause;
    Tick noticed;                    // by whom is in the story; where nobody did, the time of the cause
    std::optional<Tick> rest;        // all axes are; nothing: none was moving, or it is not known
    std::vector<std::string> story;  // the cause, who noticed, how it ended: a sentence each
};

Verdict judge(const Incident& incident);

}  // namespace lockstep::incident
