#include "core/flight/axis_flight.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

FlightKind kind_of(AxisNotice::Kind kind) {
    using Kind = AxisNotice::Kind;
    switch (kind) {
        case Kind::OwnerAdopted: return FlightKind::OwnerFollowed;
        case Kind::EpochBegun: return FlightKind::EpochBegun;
        case Kind::EpochEnded: return FlightKind::EpochEnded;
        case Kind::FrameRefused: return FlightKind::FrameRefused;
        case Kind::Vetoed: return FlightKind::Vetoed;
        case Kind::Touched: return FlightKind::Touched;
        case Kind::StepsCorrected: return FlightKind::StepsCorrected;
        case Kind::HomingStage: return FlightKind::HomingStage;
        case Kind::Homed: return FlightKind::Homed;
        case Kind::Fault: return FlightKind::Fault;
        case Kind::Reset: return FlightKind::Reset;
        case Kind::CommandRefused: return FlightKind::CommandRefused;
        case Kind::PositionProved:
        case Kind::PositionUnproved: return FlightKind::PositionClaimed;
    }
    return FlightKind::Fault;
}

VetoReason reason_of(const FailedCheck& check) {
    if (check.too_late) { return VetoReason::TooLate; }
    if (!check.held) { return VetoReason::NotHeld; }
    return !check.lacking.empty() ? VetoReason::NoEvidence : VetoReason::NoCoordinator;
}

}  // namespace

AxisFlight::AxisFlight(MotorIndex motor, const MachineConfig& machine, FlightLog& log)
    : motor_(motor),
      ticks_per_second_(machine.ticks_per_second()),
      log_(log),
      loop_(machine),
      owner_(kFlightCoordinator, silence_limits(machine)) {
    for (const MotorIndex m : motor_indices(motor_count(machine))) {
        axes_.emplace_back(flight_axis(m), silence_limits(machine));
    }
}

void AxisFlight::take(const AxisInputs& in, const AxisOutputs& out) {
    const Ticks missed = loop_.loop(in.now, log_);
    receive(in);
    owner_.look(in.now, missed, log_);
    for (PeerWatch& axis : axes_) { axis.look(in.now, missed, log_); }
    ran_ = in.device.frame;
    for (const AxisNotice& notice : out.notices) { take_notice(in.now, notice); }
    for (const DeviceOrder& order : out.orders) { take_order(in.now, order); }
    take_tracks(out);
    if (out.state) { note_state(in.now, *out.state); }
}

void AxisFlight::receive(const AxisInputs& in) {
    for (const AxisState& peer : in.peers) {
        if (peer.axis >= axes_.size() || peer.axis == motor_) { continue; }
        axes_[peer.axis].receive(in.now, {peer.identity, peer.fault, peer.epoch, peer.veto}, log_);
        if (peer.touch) { touched_ = std::max(touched_, peer.touch->epoch); }
    }
    for (const MachineState& state : in.coordinator) {
        if (state.phase != MachinePhase::Standby) { receive_owner(in.now, state); }
    }
    for (const AxisCommand& command : in.commands) {
        if (command.axis != motor_ || command.sequence <= order_) { continue; }
        order_ = command.sequence;
        log_.add({.tick = in.now,
                  .kind = FlightKind::OrderReceived,
                  .detail = static_cast<std::uint8_t>(command.kind),
                  .count = static_cast<std::int64_t>(command.sequence)});
    }
}

void AxisFlight::receive_owner(Tick now, const MachineState& state) {
    owner_.receive(now, {state.term.coordinator, state.fault, state.epoch, state.veto}, log_);
    if (machine_phase_ == state.phase) { return; }
    machine_phase_ = state.phase;
    log_.add({.tick = now,
              .kind = FlightKind::MachinePhaseReceived,
              .about = kFlightCoordinator,
              .detail = static_cast<std::uint8_t>(state.phase)});
}

void AxisFlight::take_order(Tick now, const DeviceOrder& order) {
    if (const auto* begin = std::get_if<device::BeginRun>(&order)) { own_run_ = begin->own; }
    if (std::holds_alternative<device::StopNow>(order)) { log_.add({.tick = now, .kind = FlightKind::PulsesStopped}); }
    if (own_run_) { return; }
    if (const auto* load = std::get_if<device::LoadFrame>(&order)) {
        if (load->last) { last_frame_ = load->number; }
        log_.add({.tick = now,
                  .kind = FlightKind::FrameHeld,
                  .epoch = epoch_,
                  .frame = load->number,
                  .lasts = load->start - now});
    }
    if (const auto* arm = std::get_if<device::Arm>(&order)) {
        log_.add({.tick = now, .kind = FlightKind::FrameArmed, .epoch = epoch_, .frame = arm->number});
    }
}

/// Notes the tails that were run, each at the tick at which it began.
void AxisFlight::take_tracks(const AxisOutputs& out) {
    for (const ExecutedTrack& track : out.tracks) {
        if (!track.tail || track.epoch == 0) { continue; }
        log_.add({.tick = track.start,
                  .kind = FlightKind::TailRun,
                  .epoch = track.epoch,
                  .frame = track.frame,
                  .lasts = total_ticks(track.pieces)});
    }
}

void AxisFlight::take_notice(Tick now, const AxisNotice& notice) {
    using Kind = AxisNotice::Kind;
    FlightEvent event{.tick = now, .kind = kind_of(notice.kind), .fault = notice.fault};
    const bool is_of_epoch = notice.kind == Kind::EpochBegun || notice.kind == Kind::EpochEnded;
    const bool is_of_frame = notice.kind == Kind::FrameRefused || notice.kind == Kind::Vetoed;
    if (notice.kind == Kind::EpochBegun) {
        epoch_ = notice.number;
        last_frame_.reset();
    }
    if (is_of_epoch || is_of_frame) { event.epoch = epoch_; }
    if (is_of_frame) { event.frame = notice.number; }
    if (!is_of_epoch && !is_of_frame) { event.count = static_cast<std::int64_t>(notice.number); }
    const bool vetoed = notice.kind == Kind::Vetoed;
    if (vetoed) { event.detail = static_cast<std::uint8_t>(VetoReason::Own); }
    if (notice.check) {
        event.detail = static_cast<std::uint8_t>(reason_of(*notice.check));
        event.count = static_cast<std::int64_t>(notice.check->lacking.bits());
    }
    log_.add(event);
    if (notice.kind == Kind::Touched) { touched_ = epoch_; }
    if (notice.kind == Kind::Fault) { log_.incident(now, IncidentReason::Fault); }
    if (vetoed && notice.check) { log_.incident(now, IncidentReason::Veto); }
    if (notice.kind == Kind::EpochEnded) { end_epoch(now); }
    if (notice.kind == Kind::OwnerAdopted && std::exchange(has_owner_, true)) {
        log_.incident(now, IncidentReason::Takeover);
    }
}

/// A motion was interrupted if it ended early although the owner's last received phase is Running, and no probe
/// touched.
void AxisFlight::end_epoch(Tick now) {
    const bool is_complete = (last_frame_ && ran_ == *last_frame_) || touched_ == epoch_;
    if (!is_complete && machine_phase_ == MachinePhase::Running) { log_.incident(now, IncidentReason::Interrupted); }
}

/// Notes the state at each change of phase, and ten times a second.
void AxisFlight::note_state(Tick now, const AxisState& state) {
    const Ticks period{static_cast<std::int64_t>(ticks_per_second_ / 10)};
    const bool is_new_phase = phase_ != state.phase;
    phase_ = state.phase;
    if (!is_new_phase && noted_ && now - *noted_ < period) { return; }
    noted_ = now;
    log_.add({.tick = state.tick,
              .kind = is_new_phase ? FlightKind::Phase : FlightKind::State,
              .detail = static_cast<std::uint8_t>(state.phase),
              .fault = state.fault,
              .epoch = state.epoch,
              .frame = state.ran,
              .count = state.position.count(),
              .amount = state.velocity.steps_per_tick() * ticks_per_second_,
              .lasts = state.clock_error});
}

}  // namespace lockstep
