// The cause of an incident, as far as the processes' notes show it; which process noticed it first; and how it ended.
//
// The first symptom names suspects: of an axis without evidence those it lacks, of a lost frame the coordinator, of a
// fault its axis. A suspect is explained by its own notes and those of others: it ended, it stood still, it refused, it
// was cut off. Only a standstill longer than the machine's stall_slots can have had an effect, and only if it overlaps
// the time in which the frame in question was sent and decided.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

enum class CauseKind : std::uint8_t {
    Ended,          // a process ended: killed, or crashed
    Stalled,        // a process stood still, and continued
    Hangs,          // a process still stands still
    HostStalled,    // several stood still at the same time
    CutOff,         // the network carried nothing of one process, or between two
    Fault,          // an axis or the machine noticed one in itself
    Refused,        // an axis refused a frame
    EmergencyStop,  // was commanded
    Asked,          // nothing was wrong: a person requested the notes
    Unknown         // the files do not show it
};
std::string_view name_of(CauseKind kind);

struct Cause {
    CauseKind kind = CauseKind::Unknown;
    std::optional<FlightPeer> who;  // nothing: no single process
    std::string text;               // a sentence without its stop
    std::optional<Tick> at;
    Ticks lasts;
};

struct Evaluation {
    Cause cause;
    Tick noticed;                    // by the process in the story; without a symptom, the time of the cause
    std::optional<Tick> rest;        // all axes are; nothing: none was moving, or it is not known
    std::vector<std::string> story;  // the cause, the first symptom, the end: a sentence each
};

Evaluation evaluate(const Incident& incident);

}  // namespace lockstep::incident
