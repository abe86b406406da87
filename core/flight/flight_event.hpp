// The notes of a process for analysis after a fault: messages received, decisions, messages published. Events are small
// values of one size, so keeping the last seconds of them costs almost nothing.
//
// All times are machine time. The fields that each kind fills in are listed beside it. All others are 0.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include "core/faults.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

// X(name, text name). Files and reports contain the text names. A name is never reused for another kind.
#define LOCKSTEP_FLIGHT_KINDS(X)                                                                                     \
    /* received */                                                                                                   \
    X(PeerSilent, "peer-silent")             /* about; lasts: since its last message */                              \
    X(PeerReceived, "peer-heard")            /* about; lasts: the silence that has ended; 0: its first message */    \
    X(PeerVeto, "peer-veto")                 /* about, epoch, frame */                                               \
    X(PeerFault, "peer-fault")               /* about, fault */                                                      \
    X(PeerRestarted, "peer-restarted")       /* about; another process publishes for it now */                       \
    X(CommandReceived, "command-heard")      /* detail: CommandKind */                                               \
    X(OrderReceived, "order-heard")          /* detail: AxisCommandKind; count: its number */                        \
    X(MachinePhaseReceived, "machine-phase") /* about: the coordinator; detail: MachinePhase */                      \
    /* decided */                                                                                                    \
    X(FrameHeld, "frame-held")         /* epoch, frame; lasts: from now to its start */                              \
    X(FrameRefused, "frame-refused")   /* epoch, frame, fault */                                                     \
    X(FrameArmed, "frame-armed")       /* epoch, frame */                                                            \
    X(Vetoed, "vetoed")                /* epoch, frame; detail: VetoReason; count: bit i: no evidence from axis i */ \
    X(TailRun, "tail-run")             /* epoch, frame: its tail began at `tick`; lasts: until rest */               \
    X(PulsesStopped, "pulses-stopped") /* by an emergency stop */                                                    \
    X(OwnerFollowed, "owner-followed") /* count: the term's number */                                                \
    X(EpochBegun, "epoch-begun")       /* epoch */                                                                   \
    X(EpochEnded, "epoch-ended")       /* epoch */                                                                   \
    X(HomingStage, "homing-stage")     /* count: number of the stage */                                              \
    X(Homed, "homed")                                                                                                \
    X(Fault, "fault") /* fault; about: the axis, if the coordinator notes it */                                      \
    X(Reset, "reset")                                                                                                \
    X(CommandRefused, "command-refused") /* fault */                                                                 \
    X(AxisSeen, "axis-seen")             /* about */                                                                 \
    X(AxisGone, "axis-gone")             /* about */                                                                 \
    X(Interrupted, "interrupted")        /* frame: the last one run; motion continues from there */                  \
    X(Claimed, "claimed")                /* count: the term's number; now owns the machine */                        \
    X(StoodDown, "stood-down")           /* count: the term's number; another owns the machine */                    \
    X(JobCutShort, "job-cut-short")      /* count: near this line of the G-code */                                   \
    X(JobBegun, "job-begun")             /* count: its number */                                                     \
    X(JobEnded, "job-ended")             /* count: its number; detail: JobOutcome */                                 \
    /* published */                                                                                                  \
    X(State, "state")          /* detail: phase; epoch; frame: run; count: steps; amount: steps/s; */                \
                               /* lasts: clock error. Coordinator: frame: sent; count: line */                       \
    X(Phase, "phase")          /* the same, when the phase has changed */                                            \
    X(FrameSent, "frame-sent") /* epoch, frame; lasts: from now to its start */                                      \
    X(OrderSent, "order-sent") /* about; detail: AxisCommandKind; count: its number */                               \
    /* about itself */                                                                                               \
    X(Started, "started")   /* its first loop */                                                                     \
    X(Stalled, "stalled")   /* lasts: how long its loop did not run until now */                                     \
    X(Loops, "loops")       /* of the last second: count; lasts: the longest gap between two */                      \
    X(Incident, "incident") /* detail: IncidentReason; about, if any; the events before it are worth a file */       \
    X(PositionClaimed, "position-claimed") /* at its start; fault: why the kept position is refused */               \
    X(JobContinued, "job-continued")       /* count: near this line of the G-code */                                 \
    X(Reopened, "reopened")                /* its DDS participant; detail: ReopenReason; count: how often */         \
    X(LoopStuck, "loop-stuck")             /* lasts: how long its loop did not run; the process ends itself */       \
    X(Touched, "touched")                  /* count: the tick at which the input of its epoch touched */             \
    X(StepsCorrected, "steps-corrected")   /* count: steps lost, which it makes up at rest */

enum class FlightKind : std::uint8_t {
#define X(name, text) name,
    LOCKSTEP_FLIGHT_KINDS(X)
#undef X
};

std::string_view name_of(FlightKind kind);
/// Returns nullopt if this version has no such kind; a later version may have it.
std::optional<FlightKind> flight_kind(std::string_view name);

/// Why an axis does not arm a frame. The first reason that applies counts.
enum class VetoReason : std::uint8_t {
    TooLate,       // its check came too late to arm or veto this frame
    NotHeld,       // it does not hold the frame
    NoEvidence,    // it lacks a fresh state of some other axis that holds the frame
    Own,           // it is at fault or stopped, which its own state shows
    NoCoordinator  // it lacks evidence from the coordinator
};

enum class IncidentReason : std::uint8_t {
    Fault,        // of the process itself, of another one, or of the machine
    Veto,         // its own veto, without a request
    Interrupted,  // motion ended early without a request
    AxisLost,     // an axis fell silent or was restarted
    OwnerLost,    // the owner fell silent
    Takeover,     // another coordinator owns the machine
    Asked,        // a person asked for a file
    Ended         // the process ended without a request
};
std::string_view name_of(IncidentReason reason);
std::optional<IncidentReason> incident_reason(std::string_view name);

/// Another process of the machine.
struct FlightPeer {
    enum class Kind : std::uint8_t { None, Axis, Coordinator };
    Kind kind = Kind::None;
    std::uint8_t axis = 0;  // the place of its motor
    bool operator==(const FlightPeer&) const = default;

    constexpr MotorIndex motor() const { return MotorIndex{axis}; }
};
constexpr FlightPeer flight_axis(MotorIndex motor) {
    return {FlightPeer::Kind::Axis, static_cast<std::uint8_t>(motor)};
}
inline constexpr FlightPeer kFlightCoordinator{FlightPeer::Kind::Coordinator, 0};

struct FlightEvent {
    Tick tick;
    FlightKind kind = FlightKind::Started;
    FlightPeer about;
    std::uint8_t detail = 0;
    FaultCode fault = FaultCode::None;
    std::uint16_t reserved = 0;
    Epoch epoch = 0;
    FrameNumber frame = 0;
    std::int64_t count = 0;
    double amount = 0;
    Ticks lasts;
    bool operator==(const FlightEvent&) const = default;
};
static_assert(std::is_trivially_copyable_v<FlightEvent> && sizeof(FlightEvent) == 56);

/// Takes the events and keeps the newest ones.
class FlightLog {
public:
    virtual ~FlightLog() = default;
    /// Never waits.
    virtual void add(const FlightEvent& event) = 0;
    /// Sets the reason for which the process is about to end itself. Safe while the rest of the process is in an
    /// unknown state.
    virtual void set_note(std::string_view text) = 0;

    void incident(Tick now, IncidentReason reason, FlightPeer about = {}) {
        add({.tick = now, .kind = FlightKind::Incident, .about = about, .detail = static_cast<std::uint8_t>(reason)});
    }
};

}  // namespace lockstep
