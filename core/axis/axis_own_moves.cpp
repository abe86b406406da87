// The moves an axis makes by itself: homing, and from point to point. They are made of frames too, loaded as the device
// takes them; one that runs out of frames rests by its tail, and goes on from there.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/axis/axis_controller.hpp"

namespace lockstep {
namespace {

/// Ahead of the device there are two frames, each longer than a process may stall.
Ticks frame_span(const MachineConfig& machine) { return machine.slot_ticks() * (machine.timing.stall_slots + 2); }
constexpr std::int64_t kSpansAhead = 2;

}  // namespace

const HeldFrame* AxisController::LocalRun::find(FrameNumber number) const {
    const auto found = std::ranges::find(held, number, &HeldFrame::number);
    return found == held.end() ? nullptr : &*found;
}

void AxisController::begin_own_move(const AxisCommand& command, const DeviceStatus& device, AxisOutputs& out) {
    const std::int64_t steps = command.target_steps - machine_position(device.position).count();
    if (const FaultCode why = refusal_of(command, steps); why != FaultCode::None) { return refuse(command, why, out); }
    if (steps == 0) { return done(FaultCode::None); }
    start_local({.steps = steps, .speed_mm_s = machine_.axes[axis_].max_velocity_mm_s, .ticks = command.ticks}, 0, out);
}

FaultCode AxisController::refusal_of(const AxisCommand& command, std::int64_t steps) const {
    if (mode_ != Mode::Rest || device_.moving) { return FaultCode::Busy; }
    if (fault_ != FaultCode::None) { return FaultCode::InFault; }
    if (!homed_ || phase_ != AxisPhase::Standby) { return FaultCode::NotHomed; }
    if (command.target_steps < limits_.min_steps || command.target_steps > limits_.max_steps) {
        return FaultCode::OutsideTravel;
    }
    const AxisConfig& axis = machine_.axes[axis_];
    const OwnMoveRequest request{std::max<std::int64_t>(1, std::abs(steps)), axis.max_velocity_mm_s, command.ticks};
    const bool possible = OwnPieces::plan(axis, machine_.tick_ns, axis.method, request, begin_steps_).has_value();
    return possible ? FaultCode::None : FaultCode::BadProgram;
}

void AxisController::take_homing_step(const HomingStep& step, AxisOutputs& out) {
    out.notices.push_back({AxisNotice::Kind::HomingStage, step.fault, static_cast<std::uint64_t>(homing_.stage())});
    if (step.zeroed) {
        zero_count_ = step.zero_count;
        encoder_zero_ = device_.encoder_count - device_.position.count();  // what was lost before is lost
        homed_ = true;
        happen(AxisEvent::Zeroed);
    } else if (phase_ == AxisPhase::Stop && step.fault == FaultCode::None) {
        happen(AxisEvent::HomingBegins);
    }
    if (step.fault != FaultCode::None) {
        homed_ = false;
        fail(step.fault, out);
        return done(step.fault);
    }
    if (step.move && step.move->steps != 0) { return start_local(*step.move, 0, out); }
    if (step.move) { return take_homing_step(homing_.next({.count = device_.position.count()}), out); }
    if (step.done) {
        out.notices.push_back({AxisNotice::Kind::Homed, FaultCode::None, 0});
        done(FaultCode::None);
    }
}

/// By the axis's method; or by Ranade's, where homing is slower or longer than the method knows.
OwnMove AxisController::own_move(const LocalMove& move, Tick start) const {
    const AxisConfig& axis = machine_.axes[axis_];
    const OwnMoveRequest request{std::abs(move.steps), move.speed_mm_s, move.ticks};
    auto pieces = OwnPieces::plan(axis, machine_.tick_ns, axis.method, request, begin_steps_);
    if (!pieces) {
        pieces =
            OwnPieces::plan(axis, machine_.tick_ns, StepMethod::Ranade, {request.steps, move.speed_mm_s}, begin_steps_);
    }
    const bool backward = move.steps < 0;
    const Position from = rest_position(device_.position.count() - zero_count_, backward);
    return OwnMove(std::move(*pieces), {from, backward, request.steps, start}, limits_, frame_span(machine_));
}

/// A run that a switch cut short ended on a pulse, and the next sets out from the whole step: half a step's time is
/// owed.
void AxisController::start_local(const LocalMove& move, int tries, AxisOutputs& out) {
    const Ticks half_step{static_cast<std::int64_t>(std::ceil(0.5 / limits_.start_velocity))};
    const Tick start = now_ + slot_ * (2 + tries) + half_step;
    local_.emplace(LocalRun{.move = move,
                            .frames = own_move(move, start),
                            .target = device_.position.count() + move.steps,
                            .tries = tries});
    mode_ = Mode::Local;
    recorded_ = 0;
    out.orders.emplace_back(device::BeginRun{++run_, move.trigger, true});
    feed_local(out);
}

/// Without its owner nobody can stop the axis: it stops itself. The fault halts the move.
void AxisController::watch_owner(Slot now, AxisOutputs& out) {
    if (fault_ == FaultCode::None && !hears_owner(now)) { fail(FaultCode::CoordinatorSilent, out); }
}

/// Frames are loaded until the device has enough ahead, or no room. The first is loaded at once, however late it
/// starts: without a frame the device can neither begin its run nor end it.
void AxisController::feed_local(AxisOutputs& out) {
    LocalRun& run = *local_;
    if (fault_ != FaultCode::None && !run.halted) { halt_local(out); }
    const Tick ahead = now_ + frame_span(machine_) * kSpansAhead;
    const auto wants_more = [&run, ahead] {
        return run.frames.none_made() || (!run.frames.all_made() && run.frames.end() < ahead);
    };
    while (!run.halted && (run.waiting || wants_more())) {
        if (!run.waiting) { run.waiting = run.frames.next(); }
        const std::size_t pieces = run.waiting->track.body.size() + run.waiting->track.tail.size();
        if (pieces > ring_room_) { return; }
        ring_room_ -= pieces;
        run.held.push_back(*std::exchange(run.waiting, std::nullopt));
        load(run.held.back(), out);
        out.orders.emplace_back(device::Arm{run.held.back().number});
    }
}

/// The device ends the frame in progress and runs its tail.
void AxisController::halt_local(AxisOutputs& out) {
    if (mode_ != Mode::Local) { return done(FaultCode::None); }
    local_->halted = true;
    const FrameNumber begun = device_.run == run_ ? device_.frame : 0;
    out.orders.emplace_back(device::Veto{begun + 1});
}

/// Homing that is halted is over: the axis is homed only if its zero was set already.
void AxisController::end_local(const DeviceStatus& device, AxisOutputs& out) {
    const LocalRun ended = *std::exchange(local_, std::nullopt);
    mode_ = Mode::Rest;
    const bool parks = homing_.stage() == HomingStage::Park;
    if (ended.halted) { homing_.abandon(); }
    if (device.stopped_by_trigger) { happen(AxisEvent::SwitchStops); }
    if (device.stopped_by_limit) { happen(AxisEvent::LimitStops); }
    if (ended.frames.broken()) {
        homing_.abandon();
        return fail(FaultCode::FrameBeyondLimits, out);
    }
    if (goes_on(ended, device, out)) { return; }
    if (parks || !is_homing()) { happen(AxisEvent::MotionEnds); }
    if (!is_homing()) { return end_own_move(device, out); }
    take_homing_step(homing_.next({.by_trigger = device.stopped_by_trigger,
                                   .by_limit = device.stopped_by_limit,
                                   .home_closed = device.home,
                                   .count = device.position.count(),
                                   .trigger_count = device.trigger_count,
                                   .encoder_ahead = device.encoder_count - device.position.count()}),
                     out);
}

/// This process stalled: the start was missed, and nothing has moved, or the frames ran out, and the axis rests on a
/// whole step. What is left is a move of its own.
bool AxisController::goes_on(const LocalRun& ended, const DeviceStatus& device, AxisOutputs& out) {
    LocalMove rest = ended.move;
    rest.steps = ended.target - device.position.count();
    const bool stopped = device.stopped_by_trigger || device.stopped_by_limit;
    if (stopped || ended.halted || rest.steps == 0) { return false; }
    if (device.frame > 0) { rest.ticks = {}; }
    const int tries = device.frame > 0 ? 0 : ended.tries + 1;
    if (tries > kMaxTries) {
        fail(FaultCode::DeviceFault, out);
    } else {
        start_local(rest, tries, out);
    }
    return true;
}

void AxisController::abandon_local() {
    homing_.abandon();
    local_.reset();
    mode_ = Mode::Rest;
}

void AxisController::end_own_move(const DeviceStatus& device, AxisOutputs& out) {
    if (!device.stopped_by_limit) { return done(FaultCode::None); }
    homed_ = false;
    fail(FaultCode::LimitHit, out);
}

}  // namespace lockstep
