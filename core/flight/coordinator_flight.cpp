#include "core/flight/coordinator_flight.hpp"

#include "core/kinematics/motors.hpp"
#include "core/protocol/needs_lease.hpp"

namespace lockstep {
namespace {

/// Returns nullopt for notices that are not noted here.
std::optional<FlightKind> kind_of(CoordinatorNotice::Kind kind) {
    using Kind = CoordinatorNotice::Kind;
    switch (kind) {
        case Kind::Phase: return std::nullopt;
        case Kind::Fault: return FlightKind::Fault;
        case Kind::AxisSeen: return FlightKind::AxisSeen;
        case Kind::AxisGone: return FlightKind::AxisGone;
        case Kind::Interrupted: return FlightKind::Interrupted;
        case Kind::EpochBegun: return FlightKind::EpochBegun;
        case Kind::Claimed: return FlightKind::Claimed;
        case Kind::StoodDown: return FlightKind::StoodDown;
        case Kind::JobCutShort: return FlightKind::JobCutShort;
        case Kind::JobContinued: return FlightKind::JobContinued;
        case Kind::UnattendedRunsOn:
        case Kind::UnattendedHeld:
        case Kind::HeldByInput:
        case Kind::TouchInMotion:
        case Kind::ProgramLate:
        case Kind::ProgramCut: return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

CoordinatorFlight::CoordinatorFlight(const MachineConfig& machine, FlightLog& log)
    : ticks_per_second_(machine.ticks_per_second()),
      log_(log),
      loop_(machine),
      other_owner_(kFlightCoordinator, silence_limits(machine)),
      orders_(motor_count(machine)) {
    for (const MotorIndex m : motor_indices(motor_count(machine))) {
        axes_.emplace_back(flight_axis(m), silence_limits(machine));
    }
}

void CoordinatorFlight::take(const CoordinatorInputs& in, const CoordinatorOutputs& out) {
    const Ticks missed = loop_.loop(in.now, log_);
    receive(in);
    if (phase_ == MachinePhase::Standby) { other_owner_.look(in.now, missed, log_); }
    for (PeerWatch& axis : axes_) { axis.look(in.now, missed, log_); }
    for (const CoordinatorNotice& notice : out.notices) { take_notice(in.now, notice); }
    for (const JobEvent& job : out.jobs) { take_job(in.now, job); }
    for (const Reply& reply : out.replies) {
        if (reply.status != ReplyStatus::Refused) { continue; }
        log_.add({.tick = in.now, .kind = FlightKind::CommandRefused, .fault = reply.fault});
    }
    send(in.now, out);
    if (out.state) { note_state(in.now, *out.state); }
}

void CoordinatorFlight::receive(const CoordinatorInputs& in) {
    for (const AxisState& axis : in.axes) {
        if (axis.axis >= axes_.size()) { continue; }
        axes_[axis.axis].receive(in.now, {axis.identity, axis.fault, axis.epoch, axis.veto}, log_);
    }
    for (const MachineState& other : in.others) {
        if (other.phase == MachinePhase::Standby) { continue; }
        knew_owner_ = true;
        other_owner_.receive(in.now, {other.term.coordinator, other.fault, other.epoch, {}}, log_);
    }
    for (const Command& command : in.commands) { receive_command(in.now, command); }
}

/// Notes only the first of equal commands. A client repeats a command until the answer, a jog for as long as it lasts,
/// and its request for the lease for as long as it is the writer. Other commands may come in between.
void CoordinatorFlight::receive_command(Tick now, const Command& command) {
    const LastCommands* known = commands_.find(command.client);
    LastCommands last = known == nullptr ? LastCommands{} : *known;
    std::uint64_t& sequence = is_about_lease(command.kind) ? last.about_lease : last.other;
    if (known != nullptr && sequence == command.sequence) { return; }
    sequence = command.sequence;
    commands_.note(command.client, last);
    log_.add({.tick = now, .kind = FlightKind::CommandReceived, .detail = static_cast<std::uint8_t>(command.kind)});
}

void CoordinatorFlight::take_notice(Tick now, const CoordinatorNotice& notice) {
    using Kind = CoordinatorNotice::Kind;
    const auto kind = kind_of(notice.kind);
    if (!kind) { return; }
    FlightEvent event{.tick = now, .kind = *kind, .fault = notice.fault};
    switch (notice.kind) {
        case Kind::Fault:
            if (is_of_an_axis(notice.fault)) { event.about = flight_axis(MotorIndex{notice.number}); }
            break;
        case Kind::AxisSeen:
        case Kind::AxisGone: event.about = flight_axis(MotorIndex{notice.number}); break;
        case Kind::Interrupted: event.frame = notice.number; break;
        case Kind::EpochBegun: event.epoch = notice.number; break;
        default: event.count = static_cast<std::int64_t>(notice.number);
    }
    log_.add(event);
    const bool is_takeover = notice.kind == Kind::StoodDown || (notice.kind == Kind::Claimed && knew_owner_);
    if (notice.kind == Kind::Fault) { log_.incident(now, IncidentReason::Fault, event.about); }
    if (notice.kind == Kind::Interrupted) { log_.incident(now, IncidentReason::Interrupted); }
    if (notice.kind == Kind::AxisGone) { log_.incident(now, IncidentReason::AxisLost, event.about); }
    if (is_takeover) { log_.incident(now, IncidentReason::Takeover); }
}

void CoordinatorFlight::take_job(Tick now, const JobEvent& job) {
    const bool begins = job.kind == JobEvent::Kind::Begun;
    if (!begins && job.kind != JobEvent::Kind::Ended) { return; }
    log_.add({.tick = now,
              .kind = begins ? FlightKind::JobBegun : FlightKind::JobEnded,
              .detail = begins ? std::uint8_t{0} : static_cast<std::uint8_t>(job.outcome),
              .count = static_cast<std::int64_t>(job.job)});
}

/// Notes only the first sending of each frame and order. They are repeated until they have arrived.
void CoordinatorFlight::send(Tick now, const CoordinatorOutputs& out) {
    for (const Frame& frame : out.frames) {
        if (frame.epoch == epoch_ && frame.number <= sent_) { continue; }
        epoch_ = frame.epoch;
        sent_ = frame.number;
        log_.add({.tick = now,
                  .kind = FlightKind::FrameSent,
                  .epoch = frame.epoch,
                  .frame = frame.number,
                  .lasts = frame.start - now});
    }
    for (const AxisCommand& order : out.axis_commands) {
        if (order.axis >= orders_.size() || orders_[order.axis] == order.sequence) { continue; }
        orders_[order.axis] = order.sequence;
        log_.add({.tick = now,
                  .kind = FlightKind::OrderSent,
                  .about = flight_axis(MotorIndex{order.axis}),
                  .detail = static_cast<std::uint8_t>(order.kind),
                  .count = static_cast<std::int64_t>(order.sequence)});
    }
}

/// Notes the state at each change of phase, and ten times a second.
void CoordinatorFlight::note_state(Tick now, const MachineState& state) {
    const Ticks period{static_cast<std::int64_t>(ticks_per_second_ / 10)};
    const bool is_new_phase = phase_ != state.phase;
    phase_ = state.phase;
    if (!is_new_phase && noted_ && now - *noted_ < period) { return; }
    noted_ = now;
    log_.add({.tick = now,
              .kind = is_new_phase ? FlightKind::Phase : FlightKind::State,
              .detail = static_cast<std::uint8_t>(state.phase),
              .fault = state.fault,
              .epoch = state.epoch,
              .frame = state.sent,
              .count = state.line.value_or(0)});
}

}  // namespace lockstep
