// Finds the cause of an incident as far as the processes' notes show it, the process that noticed it first, and how it
// ended.
//
// The first symptom names suspects. If an axis lacks evidence, the suspects are the axes that it has no evidence of. If
// a frame is not held, it is the coordinator. For a fault, it is the axis with the fault. The notes of the suspect and
// of others show what happened to it: its process ended, it stalled, it refused a frame, or it was cut off. A
// standstill counts only if it lasts at least the machine's stall_slots and overlaps the time in which the frame in
// question was sent and decided.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

enum class CauseKind : std::uint8_t {
    Ended,          // a process was killed or crashed
    Stalled,        // a process did not run for a while, and continued
    Hangs,          // a process still does not run
    HostStalled,    // several processes did not run at the same time
    CutOff,         // the network carried no messages of one process, or between two
    Fault,          // an axis or the machine noticed a fault of its own
    Refused,        // an axis refused a frame
    EmergencyStop,  // somebody commanded an emergency stop
    Asked,          // nothing was wrong: a person requested the notes
    Unknown         // the files do not show it
};
std::string_view name_of(CauseKind kind);

struct Cause {
    CauseKind kind = CauseKind::Unknown;
    std::optional<FlightPeer> who;  // nullopt if it is no single process
    std::string text;               // a sentence without its stop
    std::optional<Tick> at;
    Ticks lasts;
};

struct Evaluation {
    Cause cause;
    Tick noticed;                    // by the process in the story; the time of the cause if there is no symptom
    std::optional<Tick> rest;        // when all axes are at rest; nullopt if none was moving, or if not known
    MotorSet moving;                 // when the incident began
    std::vector<std::string> story;  // the cause, the first symptom, the motion and its end: a sentence each
};

Evaluation evaluate(const Incident& incident);

}  // namespace lockstep::incident
