#include "core/axis/axis_controller.hpp"

#include <cstdlib>
#include <utility>

#include "core/axis/state/placing.hpp"
#include "core/kinematics/motor_inputs.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {

AxisController::AxisController(MotorIndex motor, const MachineConfig& machine, Identity identity,
                               std::uint64_t config_hash, BeginSteps begin_steps, KeptOrNot kept)
    : motor_(motor),
      identity_(identity),
      config_hash_(config_hash),
      slot_(machine.slot_ticks()),
      stop_inputs_(inputs_with(machine, motor_name(machine, motor), InputUse::EmergencyStop)),
      condition_{.phases = {}, .position = {machine, motor, std::move(kept)}, .orders = {}},
      owner_(machine.timing),
      following_(motor, machine),
      own_(motor, machine, begin_steps),
      outputs_(motor, machine) {}

const AxisOutputs& AxisController::step(const AxisInputs& inputs) {
    out_.clear();
    const Slot slot = rules::slot_of(inputs.now, slot_);
    AxisLoop loop{inputs.now, slot, gate_.next(slot), condition_, device_, out_};
    owner_.forgive(gate_.missed(loop.slot));
    look(inputs, loop);
    condition_.position.follow(out_.tracks);
    receive(inputs, loop);
    move_on(loop);
    tend_outputs(loop);
    publish(inputs, loop);
    return out_;
}

void AxisController::look(const AxisInputs& inputs, AxisLoop& loop) {
    if (!inputs.has_device) {
        if (device_.is_present()) { lose_device(loop); }
        return;
    }
    const bool is_new = device_.appear();
    if (is_new) { find_device(inputs, loop); }
    device_.see(inputs.device, is_resting());
    encoder_.look(inputs.device, is_new);
    if (!is_resting() && device_.is_in_newest_run()) { observe_run(loop); }
    if (phase() == AxisPhase::Stop && is_resting()) { release(); }
    check_stop_inputs(loop);
    check_encoder(loop);
    if (inputs.device_failed && condition_.phases.fault() != FaultCode::DeviceFault) {
        condition_.position.lose();
        following_.veto(loop);
        loop.fail(FaultCode::DeviceFault);
    }
}

/// An axis has to be homed again. The place of a board is known.
void AxisController::release() {
    condition_.phases.happen(AxisEvent::Released);
    if (condition_.position.is_board()) { condition_.phases.happen(AxisEvent::PositionKept); }
}

/// Takes a device that was found. Runs that it made before do not count as runs of this process.
void AxisController::find_device(const AxisInputs& inputs, AxisLoop& loop) {
    loop.out.device_changed = true;
    const FaultCode unproved = condition_.position.claim(inputs.device, inputs.device_failed);
    if (unproved != FaultCode::None) { return loop.notice({AxisNotice::Kind::PositionUnproved, unproved, 0}); }
    condition_.phases.happen(AxisEvent::PositionKept);
    loop.notice({AxisNotice::Kind::PositionProved, FaultCode::None, 0});
}

/// The device is assumed to make no pulses after its last reading, so its run ends there. Only the device itself can
/// prove where the slide is, if it comes back.
void AxisController::lose_device(AxisLoop& loop) {
    DeviceStatus end = device_.status();
    end.finished = end.stopped_by_host = true;
    const bool was_in_run = device_.is_in_newest_run();
    if (following_.is_open()) {
        following_.veto(loop);
        if (was_in_run) { following_.record(end, loop); }
        following_.end(loop);
    } else if (own_.is_running() && was_in_run) {
        own_.record(end, loop);
    }
    own_.abandon();
    device_.lose();
    trend_.rest();
    condition_.position.lose_device();
    loop.fail(FaultCode::DeviceLost);
}

void AxisController::observe_run(AxisLoop& loop) {
    following_.is_open() ? following_.observe(loop) : own_.record(device_.status(), loop);
    follow_speed();
    if (device_.status().finished) { end_run(loop); }
}

/// The three moving states follow the speed of the pulses. In a coordinated run an axis is in Standby while it does not
/// move.
void AxisController::follow_speed() {
    const AxisEvent event = trend_.take(device_.status().velocity);
    if (phase() == AxisPhase::Initialize || device_.status().finished) { return; }
    if (event != AxisEvent::MotionEnds || following_.is_open()) { condition_.phases.happen(event); }
}

void AxisController::end_run(AxisLoop& loop) {
    const DeviceStatus& device = device_.status();
    const bool is_own = own_.is_running();
    const bool is_emergency = device.stopped_by_host || device.stopped_by_input;
    trend_.rest();
    if (!is_own && !device.stopped_by_limit && !is_emergency) { condition_.phases.happen(AxisEvent::MotionEnds); }
    if (is_emergency) {
        end_by_emergency(loop);
    } else if (device.capture_overflow || (device.bad_segment && !(is_own && device.frame == 0))) {
        own_.abandon();
        loop.fail(FaultCode::DeviceFault);
    } else if (is_own) {
        own_.end(loop);
    } else if (device.stopped_by_limit) {
        condition_.position.lose();
        following_.veto(loop);
        condition_.phases.happen(AxisEvent::LimitStops);
        loop.fail(FaultCode::LimitHit);
    }
    if (!is_own) { following_.end(loop); }
}

/// The device stopped by itself if its input closed, and the other axes do not know it yet.
void AxisController::end_by_emergency(AxisLoop& loop) {
    condition_.position.lose();
    own_.abandon();
    following_.veto(loop);
    condition_.phases.happen(AxisEvent::HostStops);
    if (is_emergency_stop(condition_.phases.fault())) { return; }
    loop.fail(device_.status().stopped_by_input ? FaultCode::EmergencyStopInput : FaultCode::EmergencyStopped);
}

/// At rest the device does not show by itself that no run would begin.
void AxisController::check_stop_inputs(AxisLoop& loop) {
    if (is_stop_closed() && !condition_.phases.has_fault()) { stop_now(FaultCode::EmergencyStopInput, loop); }
}

/// Compares encoder and count, also in a Fault that leaves the position known, because the slide may be pushed before
/// the reset. An encoder that counts back is noticed before the axis is homed.
void AxisController::check_encoder(AxisLoop& loop) {
    constexpr std::int64_t kUnhomed = 16;  // steps; when homed, the following error tells first
    const AxisPosition& position = condition_.position;
    if (position.has_lost_steps(device_.status())) {
        const std::int64_t error = position.following_error(device_.status());
        const FaultCode why = encoder_.counts_back(2) ? FaultCode::EncoderReversed : FaultCode::FollowingError;
        condition_.position.lose();
        return loop.fail(why, static_cast<std::uint64_t>(std::abs(error)));
    }
    if (position.homed() || condition_.phases.has_fault() || !encoder_.counts_back(kUnhomed)) { return; }
    condition_.position.lose();
    loop.fail(FaultCode::EncoderReversed);
}

void AxisController::receive(const AxisInputs& inputs, AxisLoop& loop) {
    for (const AxisState& peer : inputs.peers) { following_.take(peer, loop.slot); }
    for (const MachineState& state : inputs.coordinator) { receive(state, loop); }
    for (const AxisCommand& order : inputs.commands) {
        if (order.axis != motor_ || !owner_.is_from_owner(order.term)) { continue; }
        if (order.kind == AxisCommandKind::Jog) { own_.renew(order, loop); }
        if (condition_.orders.is_new(order.sequence)) { carry_out(order, loop); }
    }
    for (const Command& request : inputs.requests) {
        if (stops_.take(request)) { stop_now(FaultCode::EmergencyStopped, loop); }
    }
    following_.take(inputs.edges, loop);
    for (const Frame& frame : inputs.frames) {
        if (!owner_.is_from_owner(frame.term)) { continue; }
        const bool may_begin = is_resting() && condition_.may_follow();
        const Position here = condition_.position.in_machine(device_.status().position);
        following_.take(frame, may_begin ? std::optional(here) : std::nullopt, loop);
    }
}

/// A new owner makes the orders of the last owner void.
void AxisController::receive(const MachineState& state, AxisLoop& loop) {
    const OwnerLink::Sender sender = owner_.take(state, loop.slot, at_rest());
    if (sender == OwnerLink::Sender::Other) { return; }
    if (sender == OwnerLink::Sender::NewOwner) {
        condition_.orders.restart();
        loop.notice({AxisNotice::Kind::OwnerAdopted, FaultCode::None, state.term.number});
    }
    following_.take(state, loop.slot);
    outputs_.take(state);
}

void AxisController::carry_out(const AxisCommand& order, AxisLoop& loop) {
    condition_.orders.begin(order.sequence);
    switch (order.kind) {
        case AxisCommandKind::Home:
        case AxisCommandKind::Approach: return own_.home(order, is_resting(), loop);
        case AxisCommandKind::Reset: return reset(order, loop);
        case AxisCommandKind::StopNow:
            condition_.orders.end(FaultCode::None);
            return stop_now(FaultCode::EmergencyStopped, loop);
        case AxisCommandKind::MoveOwn: return own_.move(order, is_resting(), loop);
        case AxisCommandKind::Halt: return own_.halt(loop);
        case AxisCommandKind::Jog: return own_.jog(order, is_resting(), loop);
        case AxisCommandKind::Assume: return assume_place(order, is_resting(), loop);
        case AxisCommandKind::TakePlace: return take_place(order, is_resting(), loop);
        case AxisCommandKind::Correct: return own_.correct(order, is_resting(), loop);
    }
}

/// Enters the emergency stop also at rest, so that messages still on their way do not move this axis before a person
/// has reset it.
void AxisController::stop_now(FaultCode why, AxisLoop& loop) {
    if (!is_resting()) {
        loop.out.orders.emplace_back(device::StopNow{});
        following_.veto(loop);
    } else if (!condition_.phases.has_fault()) {
        condition_.phases.happen(AxisEvent::Fails);
    }
    loop.fail(why);
}

void AxisController::reset(const AxisCommand& order, AxisLoop& loop) {
    if (!is_resting()) { return loop.refuse(order, FaultCode::Busy); }
    if (is_stop_closed()) { return loop.refuse(order, FaultCode::EmergencyStopInput); }
    condition_.phases.reset(homed());
    if (!homed()) { condition_.position.lose(); }
    loop.notice({AxisNotice::Kind::Reset, FaultCode::None, 0});
    condition_.orders.end(FaultCode::None);
}

/// Without its owner no process can stop an axis in a move of its own, so the axis stops itself. The fault halts the
/// move.
void AxisController::move_on(AxisLoop& loop) {
    following_.check(loop);
    if (!own_.is_running()) { return; }
    if (!condition_.phases.has_fault() && !owner_.receives_owner(loop.slot)) {
        loop.fail(FaultCode::CoordinatorSilent);
    }
    own_.feed(loop);
}

/// While the axis follows frames, these change its outputs.
void AxisController::tend_outputs(AxisLoop& loop) {
    if (outputs_.none()) { return; }
    if (!device_.is_present() || following_.is_open()) { return outputs_.forget(); }
    if (!loop.publishes()) { return; }
    const bool is_safe = !condition_.phases.has_fault() && owner_.receives_owner(loop.slot);
    const auto change = outputs_.change({following_.follower().epoch(), is_safe, device_.status()});
    if (change) { loop.out.orders.emplace_back(*change); }
}

void AxisController::publish(const AxisInputs& inputs, AxisLoop& loop) {
    if (is_resting() && !condition_.phases.has_fault()) { loop.out.rests = condition_.position.keep(device_); }
    if (gate_.enter(loop.slot)) { loop.out.state = state(loop, inputs.clock_error); }
}

AxisState AxisController::state(const AxisLoop& loop, Ticks clock_error) const {
    const SetpointFollower& follower = following_.follower();
    const DeviceStatus& device = device_.status();
    return {.identity = identity_,
            .axis = static_cast<std::uint32_t>(motor_),
            .stamp = loop.slot,
            .epoch = follower.epoch(),
            .held = follower.held(),
            .veto = follower.veto(),
            .ran = following_.ran(),
            .at_rest = at_rest(),  // the device may still finish a run that another process began
            .homed = homed(),
            .phase = phase(),
            .fault = condition_.phases.fault(),
            .position = condition_.position.in_machine(device.position),
            .velocity = device.velocity,
            .tick = device.now,
            .following_error_steps = condition_.position.following_error(device),
            .corrected_steps = condition_.position.corrected_steps(),
            .play_steps = condition_.position.play_steps(device),
            .command_done = condition_.orders.done(),
            .command_fault = condition_.orders.fault(),
            .config_hash = config_hash_,
            .refused_frames = following_.refused_frames(),
            .clock_error = clock_error,
            .term = owner_.term(),
            .hears_owner = owner_.receives_owner(loop.slot),
            .unproved = condition_.position.unproved(),
            .switches = {device.limit_min, device.limit_max, device.home},
            .homing = own_.homing_stage(),
            .inputs = device.inputs,
            .outputs = device.outputs,
            .pulses_left = device.pulses_left,
            .analog = device.analog,
            .touch = following_.touch(),
            .ceased = following_.has_ceased()};
}

}  // namespace lockstep
