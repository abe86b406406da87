// What a process notes of itself for the time after a fault: what it heard, decided and said, as small values of one
// size, so that keeping the last seconds of them costs next to nothing.
//
// Machine time throughout. What each kind fills in stands beside it; all else is 0.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include "core/faults.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

// X(name, text name). The text names are the files' and the reports'; none is used again for another thing.
#define LOCKSTEP_FLIGHT_KINDS(X)                                                                                  \
    /* heard */                                                                                                   \
    X(PeerSilent, "peer-silent")             /* about; lasts: since its last word */                              \
    X(PeerReceived, "peer-heard")            /* about; lasts: the silence that has ended; 0: its first word */    \
    X(PeerVeto, "peer-veto")                 /* about, epoch, frame */                                            \
    X(PeerFault, "peer-fault")               /* about, fault */                                                   \
    X(PeerRestarted, "peer-restarted")       /* about: another process speaks for it now */                       \
    X(CommandReceived, "command-heard")      /* detail: CommandKind */                                            \
    X(OrderReceived, "order-heard")          /* detail: AxisCommandKind; count: its number */                     \
    X(MachinePhaseReceived, "machine-phase") /* about: the coordinator; detail: MachinePhase */                   \
    /* decided */                                                                                                 \
    X(FrameHeld, "frame-held")         /* epoch, frame; lasts: from now to its start */                           \
    X(FrameRefused, "frame-refused")   /* epoch, frame, fault */                                                  \
    X(FrameArmed, "frame-armed")       /* epoch, frame */                                                         \
    X(Vetoed, "vetoed")                /* epoch, frame; detail: VetoReason; count: bit i: axis i lacks */         \
    X(TailRun, "tail-run")             /* epoch, frame: the frame's tail, from tick on; lasts: until rest */      \
    X(PulsesStopped, "pulses-stopped") /* by an emergency stop */                                                 \
    X(OwnerFollowed, "owner-followed") /* count: the term's number */                                             \
    X(EpochBegun, "epoch-begun")       /* epoch */                                                                \
    X(EpochEnded, "epoch-ended")       /* epoch */                                                                \
    X(HomingStage, "homing-stage")     /* count: of the homing */                                                 \
    X(Homed, "homed")                                                                                             \
    X(Fault, "fault") /* fault; about: the coordinator names the axis */                                          \
    X(Reset, "reset")                                                                                             \
    X(CommandRefused, "command-refused") /* fault */                                                              \
    X(AxisSeen, "axis-seen")             /* about */                                                              \
    X(AxisGone, "axis-gone")             /* about */                                                              \
    X(Interrupted, "interrupted")        /* frame: the last run; goes on from there */                            \
    X(Claimed, "claimed")                /* count: the term's number; owns the machine */                         \
    X(StoodDown, "stood-down")           /* count: the term's number; another owns the machine */                 \
    X(JobCutShort, "job-cut-short")      /* count: near this line */                                              \
    X(JobBegun, "job-begun")             /* count: its number */                                                  \
    X(JobEnded, "job-ended")             /* count: its number; detail: JobOutcome */                              \
    /* said */                                                                                                    \
    X(State, "state")          /* detail: phase; epoch, frame: run; count, amount: steps, steps/s; */             \
                               /* lasts: clock error. Coordinator: frame sent, count: line */                     \
    X(Phase, "phase")          /* the same, where the phase has changed */                                        \
    X(FrameSent, "frame-sent") /* epoch, frame; lasts: from now to its start */                                   \
    X(OrderSent, "order-sent") /* about; detail: AxisCommandKind; count: its number */                            \
    /* itself */                                                                                                  \
    X(Started, "started")   /* its first loop */                                                                  \
    X(Stalled, "stalled")   /* lasts: until now, in which its loop did not run */                                 \
    X(Loops, "loops")       /* of the second before: count; lasts: the longest from one to the next */            \
    X(Incident, "incident") /* detail: IncidentReason; about, or no process; what came before is worth keeping */ \
    X(PositionClaimed, "position-claimed") /* at its start; fault: why the kept position is not believed */       \
    X(JobContinued, "job-continued")       /* count: near this line */                                            \
    X(Reopened, "reopened")                /* its DDS participant; detail: ReopenReason; count: how often */      \
    X(LoopStuck, "loop-stuck")             /* lasts: its loop did not run; the process ends itself */

enum class FlightKind : std::uint8_t {
#define X(name, text) name,
    LOCKSTEP_FLIGHT_KINDS(X)
#undef X
};

std::string_view name_of(FlightKind kind);
/// Nothing where there is no such kind: a later version's.
std::optional<FlightKind> flight_kind(std::string_view name);

/// Why an axis does not arm a frame. The first that applies.
enum class VetoReason : std::uint8_t {
    TooLate,       // it looked too late to say anything of this frame any more
    NotHeld,       // it has not got it
    NoEvidence,    // of some other axis it has heard nothing fresh that says it holds it
    Own,           // it is at fault or stopped, which it says by itself
    NoCoordinator  // the coordinator has published nothing that is evidence for it
};

enum class IncidentReason : std::uint8_t {
    Fault,        // its own, another's or the machine's
    Veto,         // its own, that nobody asked for
    Interrupted,  // motion ended before its end, and nobody asked for it
    AxisLost,     // fell silent, or was restarted
    OwnerLost,    // fell silent
    Takeover,     // another coordinator owns the machine
    Asked,        // a person did
    Ended         // the process did, and not because it was asked to
};
std::string_view name_of(IncidentReason reason);
std::optional<IncidentReason> incident_reason(std::string_view name);

/// Another process of the machine.
struct FlightPeer {
    enum class Kind : std::uint8_t { None, Axis, Coordinator };
    Kind kind = Kind::None;
    std::uint8_t axis = 0;  // its place in the configuration
    bool operator==(const FlightPeer&) const = default;
};
constexpr FlightPeer flight_axis(std::size_t axis) { return {FlightPeer::Kind::Axis, static_cast<std::uint8_t>(axis)}; }
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

/// Where events are noted: it keeps the newest.
class FlightLog {
public:
    virtual ~FlightLog() = default;
    /// Never waits.
    virtual void add(const FlightEvent& event) = 0;
    /// Why the process is about to end by itself. Safe while the rest of the process is in an unknown state.
    virtual void set_note(std::string_view text) = 0;

    void incident(Tick now, IncidentReason reason, FlightPeer about = {}) {
        add({.tick = now, .kind = FlightKind::Incident, .about = about, .detail = static_cast<std::uint8_t>(reason)});
    }
};

}  // namespace lockstep
