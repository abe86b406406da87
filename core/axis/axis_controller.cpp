#include "core/axis/axis_controller.hpp"

#include "core/check.hpp"

namespace lockstep {

AxisController::AxisController(std::size_t axis, const MachineConfig& machine, Identity identity,
                               std::uint64_t config_hash, BeginSteps begin_steps, KeptOrNot kept)
    : axis_(axis),
      machine_(machine),
      limits_(limits_of(machine.axes[axis], machine.tick_ns)),
      identity_(identity),
      config_hash_(config_hash),
      begin_steps_(begin_steps),
      slot_(machine.slot_ticks()),
      follower_(axis, machine),
      homing_(machine.axes[axis]),
      kept_(std::move(kept)) {}

AxisOutputs AxisController::step(const AxisInputs& inputs) {
    AxisOutputs out;
    now_ = inputs.now;
    clock_error_ = inputs.clock_error;
    const Slot slot = rules::slot_of(now_, slot_);
    // An owner that it has not heard because it did not run is not silent.
    if (state_slot_) { owner_heard_ += std::max<Slot>(0, slot - *state_slot_ - 1); }
    look(inputs, out);
    hear(inputs, out);
    take_frames(inputs, out);
    if (mode_ == Mode::Local) {
        watch_owner(slot, out);
        feed_local(out);
    }
    if (mode_ == Mode::Following) {
        const auto veto_before = follower_.veto();
        for (DeviceOrder& order : follower_.decide(slot)) { out.orders.push_back(std::move(order)); }
        if (follower_.veto() != veto_before) {
            out.notices.push_back(
                {AxisNotice::Kind::Vetoed, FaultCode::None, *follower_.veto(), follower_.failed_check()});
        }
    }
    out.rests = position_to_keep();
    if (!state_slot_ || slot > *state_slot_) {
        state_slot_ = slot;
        out.state = state(slot);
    }
    return out;
}

void AxisController::look(const AxisInputs& inputs, AxisOutputs& out) {
    if (!inputs.has_device) {
        if (has_device_) { lose_device(out); }
        return;
    }
    if (!std::exchange(has_device_, true)) {
        out.device_changed = true;
        claim_position(inputs, out);
    }
    observe(inputs.device, out);
    if (inputs.device_failed && fault_ != FaultCode::DeviceFault) {
        homed_ = false;
        veto_for_own_reasons(out);
        fail(FaultCode::DeviceFault, out);
    }
}

/// Once for each device found, before anything else: what it has done since is not this process's doing.
void AxisController::claim_position(const AxisInputs& inputs, AxisOutputs& out) {
    unproved_ = !kept_                 ? kept_.error()
                : inputs.device_failed ? FaultCode::DeviceFault
                                       : doubt_of(*kept_, scale_of(machine_, axis_), inputs.device);
    if (unproved_ != FaultCode::None) {
        out.notices.push_back({AxisNotice::Kind::PositionUnproved, unproved_, 0});
        return;
    }
    zero_count_ = kept_->zero_count;
    encoder_zero_ = kept_->encoder_zero;
    kept_run_ = kept_->run;
    homed_ = true;
    happen(AxisEvent::PositionKept);
    out.notices.push_back({AxisNotice::Kind::PositionProved, FaultCode::None, 0});
}

/// After each run that leaves it homed, once.
std::optional<KeptPosition> AxisController::position_to_keep() {
    const bool rests = mode_ == Mode::Rest && device_.finished && device_.run == run_ && device_.run_asked == run_;
    if (!homed_ || fault_ != FaultCode::None || !rests || kept_run_ == run_) { return std::nullopt; }
    kept_run_ = run_;
    kept_ =
        KeptPosition{scale_of(machine_, axis_), device_.power_up, run_, device_.position, zero_count_, encoder_zero_};
    return *kept_;
}

void AxisController::hear(const AxisInputs& inputs, AxisOutputs& out) {
    const Slot now = rules::slot_of(now_, slot_);
    for (const AxisState& peer : inputs.peers) {
        if (peer.stamp <= now + rules::kHopSlots) { follower_.hear(peer); }
    }
    for (const MachineState& state : inputs.coordinator) {
        if (!follows(state, now, out)) { continue; }
        owner_heard_ = now;
        follower_.hear(state);
    }
    for (const AxisCommand& command : inputs.commands) {
        const bool mine = command.axis == axis_ && command.sequence > command_taken_;
        if (mine && is_from_owner(command.term)) { carry_out(command, inputs.device, out); }
    }
    for (const Command& request : inputs.requests) {
        if (request.kind == CommandKind::EmergencyStop && is_news(request)) { stop_now(out); }
    }
}

/// A client repeats its command until it is answered: only once does it stop anything.
bool AxisController::is_news(const Command& request) {
    const std::uint64_t* const last = stops_taken_.find(request.client);
    if (last != nullptr && request.sequence <= *last) { return false; }
    stops_taken_.note(request.client, request.sequence);
    return true;
}

void AxisController::stop_now(AxisOutputs& out) {
    if (mode_ == Mode::Rest) { return; }
    out.orders.emplace_back(device::StopNow{});
    veto_for_own_reasons(out);
}

void AxisController::veto_for_own_reasons(AxisOutputs& out) {
    const auto before = follower_.veto();
    follower_.veto_for_own_reasons(rules::slot_of(now_, slot_));
    if (follower_.veto() != before) {
        out.notices.push_back({AxisNotice::Kind::Vetoed, FaultCode::None, *follower_.veto()});
    }
}

/// One owner at a time, and never a lower term than before: another is followed only when the last one has been silent
/// for long, at rest.
bool AxisController::follows(const MachineState& state, Slot now, AxisOutputs& out) {
    if (state.phase == MachinePhase::Standby) { return false; }
    if (is_from_owner(state.term)) { return true; }
    const bool believed = claimants_.again(state.term, state.stamp);
    if (!believed || !rules::may_follow(state.term, owner_, hears_owner(now), at_rest())) { return false; }
    adopt(state.term, now, out);
    return true;
}

/// Commands are counted anew: what the last owner asked for is over.
void AxisController::adopt(const Term& term, Slot now, AxisOutputs& out) {
    owner_ = term;
    owner_heard_ = now;
    command_taken_ = command_done_ = 0;
    command_fault_ = FaultCode::None;
    command_open_ = false;
    out.notices.push_back({AxisNotice::Kind::OwnerAdopted, FaultCode::None, term.number});
}

bool AxisController::hears_owner(Slot now) const {
    return owner_ != Term{} && now - owner_heard_ <= rules::silence_slots(machine_.timing);
}

void AxisController::carry_out(const AxisCommand& command, const DeviceStatus& device, AxisOutputs& out) {
    command_taken_ = command.sequence;
    command_fault_ = FaultCode::None;
    command_open_ = true;
    switch (command.kind) {
        case AxisCommandKind::Home: return begin_homing(command, device, out);
        case AxisCommandKind::Reset:
            if (mode_ != Mode::Rest) { return refuse(command, FaultCode::Busy, out); }
            reset(out);
            return done(FaultCode::None);
        case AxisCommandKind::StopNow: stop_now(out); return done(FaultCode::None);
        case AxisCommandKind::MoveOwn: return begin_own_move(command, device, out);
        case AxisCommandKind::Halt: return halt_local(out);
    }
}

void AxisController::begin_homing(const AxisCommand& command, const DeviceStatus& device, AxisOutputs& out) {
    if (mode_ != Mode::Rest || device.moving) { return refuse(command, FaultCode::Busy, out); }
    if (phase_ == AxisPhase::Fault) { return refuse(command, FaultCode::InFault, out); }
    if (!has_device_) { return refuse(command, FaultCode::DeviceMissing, out); }
    fault_ = unproved_ = FaultCode::None;
    homed_ = false;
    happen(AxisEvent::HomingBegins);
    take_homing_step(homing_.begin(device.home), out);
}

void AxisController::reset(AxisOutputs& out) {
    fault_ = FaultCode::None;
    happen(homed_ ? AxisEvent::ResetHomed : AxisEvent::ResetUnhomed);
    out.notices.push_back({AxisNotice::Kind::Reset, FaultCode::None, 0});
}

void AxisController::refuse(const AxisCommand& command, FaultCode why, AxisOutputs& out) {
    out.notices.push_back({AxisNotice::Kind::CommandRefused, why, command.sequence});
    done(why);
}

void AxisController::done(FaultCode fault) {
    if (!command_open_) { return; }
    command_open_ = false;
    command_done_ = command_taken_;
    command_fault_ = fault;
}

void AxisController::take_frames(const AxisInputs& inputs, AxisOutputs& out) {
    for (const Frame& frame : inputs.frames) {
        if (!is_from_owner(frame.term)) { continue; }
        const bool was_open = follower_.open();
        const FrameNumber held = was_open ? follower_.held() : 0;
        const std::optional<Position> rest =
            may_follow() ? std::optional(machine_position(device_.position)) : std::nullopt;
        const FaultCode fault = follower_.offer(frame, rest);
        if (!was_open && follower_.open()) { begin_following(frame.epoch, out); }
        if (fault != FaultCode::None) {
            ++refused_frames_;
            if (fault != last_refusal_) {
                out.notices.push_back({AxisNotice::Kind::FrameRefused, fault, frame.number});
            }
            last_refusal_ = fault;
        } else if (follower_.open() && follower_.held() != held) {
            last_refusal_ = FaultCode::None;
            if (held == 0) { out.orders.emplace_back(device::BeginRun{++run_, Trigger::None}); }
            load(check_found(follower_.find(follower_.held()), "the follower keeps the newest frame it holds"), out);
        }
    }
}

void AxisController::begin_following(Epoch epoch, AxisOutputs& out) {
    mode_ = Mode::Following;
    recorded_ = ran_ = 0;
    out.notices.push_back({AxisNotice::Kind::EpochBegun, FaultCode::None, epoch});
}

void AxisController::load(const HeldFrame& frame, AxisOutputs& out) const {
    AxisTrack track = frame.track;
    track.from = track.from + Displacement::steps(zero_count_);
    out.orders.emplace_back(device::LoadFrame{frame.number, frame.start, frame.last, track});
}

void AxisController::happen(AxisEvent event) {
    const auto row = find_transition(phase_, event);
    if (!row) { return; }
    ++transitions_[*row];
    phase_ = kAxisTransitions[*row].to;
}

void AxisController::fail(FaultCode fault, AxisOutputs& out) {
    const bool stops_only = fault == FaultCode::LimitHit || fault == FaultCode::EmergencyStopped;
    if (fault_ == FaultCode::None) { fault_ = fault; }
    if (!stops_only) { happen(AxisEvent::Fails); }
    done(fault);
    out.notices.push_back({AxisNotice::Kind::Fault, fault, 0});
}

AxisState AxisController::state(Slot slot) const {
    return {.identity = identity_,
            .axis = static_cast<std::uint32_t>(axis_),
            .stamp = slot,
            .epoch = follower_.epoch(),
            .held = follower_.held(),
            .veto = follower_.veto(),
            .ran = ran_,
            .at_rest = at_rest(),  // it may run out what another process began
            .homed = homed_,
            .phase = phase_,
            .fault = static_cast<std::uint16_t>(fault_),
            .position = machine_position(device_.position),
            .velocity = device_.velocity,
            .tick = device_.now,
            .following_error_steps = following_error(),
            .command_done = command_done_,
            .command_fault = static_cast<std::uint16_t>(command_fault_),
            .config_hash = config_hash_,
            .refused_frames = refused_frames_,
            .clock_error = clock_error_,
            .term = owner_,
            .hears_owner = hears_owner(slot),
            .unproved = static_cast<std::uint16_t>(unproved_)};
}

}  // namespace lockstep
