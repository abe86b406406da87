#include "clients/incident/sentences.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/kinematics/motors.hpp"
#include "core/number_text.hpp"
#include "core/protocol/names.hpp"
#include "core/protocol/needs_lease.hpp"
#include "core/protocol/reception_watch.hpp"

namespace lockstep::incident {
namespace {

using Kind = FlightKind;

/// A value that has no name here, as from a later version.
std::string numbered(std::int64_t value) { return fmt::format("number {} (not of this version)", value); }

/// The name of a value of the enumeration.
template <typename Enum>
std::string named(std::uint8_t detail) {
    const std::string_view name = name_of(static_cast<Enum>(detail));
    return name == "unknown" ? numbered(detail) : std::string(name);
}

std::string fault_name_of(FaultCode code) {
    const bool is_known = code == FaultCode::None || find_fault(code) != nullptr;
    return is_known ? std::string(lockstep::name_of(code)) : numbered(static_cast<std::int64_t>(code));
}

std::string fault_text_of(FaultCode code) {
    const FaultText* fault = find_fault(code);
    return fault == nullptr ? fault_name_of(code) : fmt::format("{} ({})", fault->name, fault->cause);
}

std::string veto_text(const Incident& incident, const FlightEvent& event) {
    switch (static_cast<VetoReason>(event.detail)) {
        case VetoReason::TooLate: return "its own check was too late";
        case VetoReason::NotHeld: return "it does not hold the frame";
        case VetoReason::Own: return "it is in Fault or stopped";
        case VetoReason::NoCoordinator: return "it has received no recent state of the coordinator";
        case VetoReason::NoEvidence:
            return "no recent state of " +
                   axes_named(incident, MotorSet::of_bits(static_cast<std::uint64_t>(event.count))) +
                   " reports that the frame is held";
    }
    return "the reason has " + numbered(event.detail);
}

std::string reopen_text(std::uint8_t reason) {
    const std::string_view text = text_of(static_cast<ReopenReason>(reason));
    return text.empty() ? "the reason has " + numbered(reason) : std::string(text);
}

std::string homing_text(std::int64_t stage) {
    if (stage < 0 || stage >= std::ssize(kHomingStages)) { return "homing: stage " + numbered(stage); }
    return "homing: " + in_words(kHomingStages[static_cast<std::size_t>(stage)], "the switch");
}

std::string phase_text(const Incident& incident, const Entry& entry) {
    const std::uint8_t detail = entry.event.detail;
    const bool is_axis = incident.processes[entry.process].who.kind == FlightPeer::Kind::Axis;
    return is_axis ? "is in " + named<AxisPhase>(detail) : "machine is " + named<MachinePhase>(detail);
}

/// The text of a received message.
std::string reception_text(const Incident& incident, const FlightEvent& event) {
    const std::string who = peer_name(incident, event.about);
    const double lasts = incident.seconds(event.lasts);
    switch (event.kind) {
        case Kind::PeerSilent: return fmt::format("has received nothing from {} for {}", who, duration(lasts));
        case Kind::PeerReceived:
            return event.lasts == Ticks{} ? "receives " + who
                                          : fmt::format("receives {} again, after {}", who, duration(lasts));
        case Kind::PeerVeto: return fmt::format("receives {}'s veto of frame {}", who, event.frame);
        case Kind::PeerFault: return fmt::format("receives {}'s fault: {}", who, fault_name_of(event.fault));
        case Kind::PeerRestarted: return fmt::format("receives another process as {}", who);
        case Kind::CommandReceived: return "receives the command " + named<CommandKind>(event.detail);
        case Kind::OrderReceived: return "receives the order " + named<AxisCommandKind>(event.detail);
        default: return "receives that the machine is " + named<MachinePhase>(event.detail);
    }
}

bool is_end(const FlightEvent& event) {
    return event.kind == Kind::Incident && event.detail == static_cast<std::uint8_t>(IncidentReason::Ended);
}

std::string incident_text(const Incident& incident, const FlightEvent& event) {
    if (is_end(event)) { return "has no more notes, because its process ended"; }
    const std::string who = event.about == FlightPeer{} ? "" : ", " + peer_name(incident, event.about);
    return fmt::format("saves its earlier notes ({}{})", named<IncidentReason>(event.detail), who);
}

/// The text of an event about frames and epochs.
std::string frame_text(const Incident& incident, const FlightEvent& event) {
    const double lasts = incident.seconds(event.lasts);
    switch (event.kind) {
        case Kind::FrameHeld: return fmt::format("holds frame {}, {} before its start", event.frame, duration(lasts));
        case Kind::FrameRefused: return fmt::format("refuses frame {}: {}", event.frame, fault_text_of(event.fault));
        case Kind::FrameArmed: return fmt::format("arms frame {}", event.frame);
        case Kind::FrameSent: return fmt::format("sends frame {}, {} before its start", event.frame, duration(lasts));
        case Kind::Vetoed: return fmt::format("vetoes frame {}: {}", event.frame, veto_text(incident, event));
        case Kind::TailRun:
            return fmt::format("runs the tail of frame {}, at rest {} later", event.frame, duration(lasts));
        case Kind::EpochBegun: return "begins an epoch, from rest to rest";
        default: return "its epoch ends, at rest";
    }
}

std::string coordinator_text(const Incident& incident, const FlightEvent& event) {
    const std::string who = peer_name(incident, event.about);
    switch (event.kind) {
        case Kind::AxisSeen: return who + " is present";
        case Kind::AxisGone: return who + " is absent";
        case Kind::Interrupted:
            return fmt::format("all axes rest together after frame {}; the job continues from there", event.frame);
        case Kind::Claimed: return "becomes the owner of the machine";
        case Kind::StoodDown: return "gives up the machine, because another coordinator owns it";
        case Kind::JobCutShort: return fmt::format("the previous owner's job ended early near line {}", event.count);
        case Kind::JobContinued: return fmt::format("continues the previous owner's job near line {}", event.count);
        case Kind::JobBegun: return fmt::format("begins job {}", event.count);
        case Kind::JobEnded: return fmt::format("job {} ends: {}", event.count, named<JobOutcome>(event.detail));
        default: return fmt::format("orders {} to {}", who, named<AxisCommandKind>(event.detail));
    }
}

std::string fault_sentence(const Incident& incident, const FlightEvent& event) {
    const bool has_axis = event.about.kind == FlightPeer::Kind::Axis && is_of_an_axis(event.fault);
    return "fault" + (has_axis ? " of " + peer_name(incident, event.about) : "") + ": " + fault_text_of(event.fault);
}

}  // namespace

Weight weight_of(const Incident& incident, const Entry& entry) {
    const bool is_axis = incident.processes[entry.process].who.kind == FlightPeer::Kind::Axis;
    const FlightEvent& event = entry.event;
    switch (event.kind) {
        case Kind::Phase: return is_axis ? Weight::Routine : Weight::Notable;
        case Kind::PeerReceived: return event.lasts == Ticks{} ? Weight::Routine : Weight::Telling;
        case Kind::CommandReceived:
            return is_about_lease(static_cast<CommandKind>(event.detail)) ? Weight::Routine : Weight::Notable;
        case Kind::OwnerFollowed:
        case Kind::CommandRefused:
        case Kind::JobBegun:
        case Kind::JobEnded:
        case Kind::Claimed:
        case Kind::Reset:
        case Kind::PositionClaimed:
        case Kind::StepsCorrected:
        case Kind::Started: return Weight::Notable;
        case Kind::PeerSilent:
        case Kind::PeerRestarted:
        case Kind::FrameRefused:
        case Kind::Vetoed:
        case Kind::TailRun:
        case Kind::PulsesStopped:
        case Kind::Fault:
        case Kind::AxisGone:
        case Kind::Interrupted:
        case Kind::StoodDown:
        case Kind::JobContinued:
        case Kind::JobCutShort:
        case Kind::Reopened:
        case Kind::LoopStuck:
        case Kind::Stalled: return Weight::Telling;
        case Kind::Incident: return is_end(event) ? Weight::Telling : Weight::Routine;
        default: return Weight::Routine;
    }
}

std::string sentence(const Incident& incident, const Entry& entry) {
    const FlightEvent& event = entry.event;
    const double lasts = incident.seconds(event.lasts);
    if (event.kind <= Kind::MachinePhaseReceived) { return reception_text(incident, event); }
    switch (event.kind) {
        case Kind::PulsesStopped: return "stops its pulses at once";
        case Kind::OwnerFollowed: return "follows an owner of the machine";
        case Kind::HomingStage: return homing_text(event.count);
        case Kind::Homed: return "is homed and parked";
        case Kind::Touched: return "sees the touch of the probe";
        case Kind::StepsCorrected: return fmt::format("makes up {} that were lost", plural(event.count, "step"));
        case Kind::Fault: return fault_sentence(incident, event);
        case Kind::Reset: return "is reset";
        case Kind::PositionClaimed:
            return event.fault == FaultCode::None ? "is homed by the kept position"
                                                  : "is not homed: " + fault_text_of(event.fault);
        case Kind::CommandRefused: return "refuses a command: " + fault_text_of(event.fault);
        case Kind::State:
        case Kind::Phase: return phase_text(incident, entry);
        case Kind::Started: return "starts";
        case Kind::Reopened: return "opens its DDS participant again: " + reopen_text(event.detail);
        case Kind::Stalled: return fmt::format("its loop has not run for {}", duration(lasts));
        case Kind::LoopStuck: return fmt::format("its loop has not run for {}, so it ends itself", duration(lasts));
        case Kind::Loops: return fmt::format("{} loops in a second, at most {} apart", event.count, duration(lasts));
        case Kind::Incident: return incident_text(incident, event);
        case Kind::FrameHeld:
        case Kind::FrameRefused:
        case Kind::FrameArmed:
        case Kind::FrameSent:
        case Kind::Vetoed:
        case Kind::TailRun:
        case Kind::EpochBegun:
        case Kind::EpochEnded: return frame_text(incident, event);
        default: return coordinator_text(incident, event);
    }
}

std::string peer_name(const Incident& incident, FlightPeer peer) {
    if (peer.kind == FlightPeer::Kind::Coordinator) { return "the coordinator"; }
    if (peer.kind == FlightPeer::Kind::None) { return "no process"; }
    return peer.axis < incident.motors.size() ? incident.motors[peer.axis] : fmt::format("axis {}", peer.axis);
}

std::string axes_named(const Incident& incident, MotorSet motors) {
    std::vector<std::string> names;
    for (const MotorIndex motor : motors) { names.push_back(peer_name(incident, flight_axis(motor))); }
    if (names.size() < 2) { return names.empty() ? "no axis" : names.front(); }
    const std::string last = names.back();
    names.pop_back();
    return fmt::format("{} and {}", fmt::join(names, ", "), last);
}

std::string duration(double seconds) {
    const double size = std::abs(seconds);
    if (size < 0.01) { return fmt::format("{:.1f} ms", seconds * 1e3); }
    return size < 1 ? fmt::format("{:.0f} ms", seconds * 1e3) : fmt::format("{:.2f} s", seconds);
}

std::string end_text(const Incident& incident, const Process& process) {
    const std::string name = peer_name(incident, process.who);
    if (process.note.empty()) {
        return fmt::format("the process of {} ended without a note: killed, or crashed", name);
    }
    return fmt::format("the process of {} ended itself: {}", name, process.note);
}

}  // namespace lockstep::incident
