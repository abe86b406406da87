#include "core/axis/own_moves/own_moves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/axis/own_moves/own_pieces.hpp"
#include "core/kinematics/motors.hpp"
#include "core/program.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kFrame_ns = 5'000'000;
// A jog has short frames, so that it ends with its renewals, and a short lead, so that it begins soon.
constexpr std::int64_t kJogFrame_ns = 2'000'000;
constexpr std::int64_t kJogLead_ns = 8'000'000;
constexpr int kMaxTries = 10;
constexpr std::int64_t kToWholeStep_ns = 10'000'000;  // how much longer than braking a halt may take

/// Why the axis cannot jog.
FaultCode jog_refusal_of(const AxisCommand& order, bool is_resting, const MotorConfig& motor, const AxisLimits& limits,
                         const AxisLoop& loop) {
    if (!is_resting || loop.device.status().moving) { return FaultCode::Busy; }
    if (loop.condition.phases.has_fault()) { return FaultCode::InFault; }
    if (!loop.device.is_present()) { return FaultCode::DeviceMissing; }
    if (order.speed_mm_s < kLeastSpeed_mm_s) { return FaultCode::BadProgram; }
    if (!loop.condition.position.homed()) { return motor.unhomed_jog_mm_s ? FaultCode::None : FaultCode::NotHomed; }
    const bool is_within = order.target_steps >= limits.min_steps && order.target_steps <= limits.max_steps;
    return is_within ? FaultCode::None : FaultCode::OutsideTravel;
}

/// A halt ends homing. The axis stays homed only if its zero was already set and it stands within its travel, because
/// no frame may start from outside.
void lose_zero_outside_travel(const AxisLimits& limits, AxisLoop& loop) {
    AxisPosition& position = loop.condition.position;
    const std::int64_t here = position.in_machine(loop.device.status().position).count();
    if (here < limits.min_steps || here > limits.max_steps) {
        position.lose();
        loop.condition.phases.happen(AxisEvent::HomingBegins);  // to be homed again
    }
}

void end_order(AxisLoop& loop) {
    if (!loop.device.status().stopped_by_limit) { return loop.condition.orders.end(FaultCode::None); }
    loop.condition.position.lose();
    loop.fail(FaultCode::LimitHit);
}

}  // namespace

OwnMoves::OwnMoves(MotorIndex motor, const MachineConfig& machine, BeginSteps begin_steps)
    : motor_(motors_of(machine)[motor]),
      limits_(limits_of(motor_, machine.tick_ns)),
      tick_ns_(machine.tick_ns),
      slot_(machine.slot_ticks()),
      lengths_{Ticks{kFrame_ns / machine.tick_ns}, Ticks{kToWholeStep_ns / machine.tick_ns},
               own_body_pieces(machine.timing)},
      ahead_(slot_ * (2 * machine.timing.stall_slots + 4)),
      jog_hold_(machine.jog_hold_ticks()),
      jog_frame_{kJogFrame_ns / machine.tick_ns},
      jog_lead_{kJogLead_ns / machine.tick_ns},
      half_step_{static_cast<std::int64_t>(std::ceil(0.5 / limits_.start_velocity))},
      begin_steps_(begin_steps),
      homing_(motor_) {}

void OwnMoves::home(const AxisCommand& order, bool is_resting, AxisLoop& loop) {
    AxisCondition& axis = loop.condition;
    if (!is_resting || loop.device.status().moving) { return loop.refuse(order, FaultCode::Busy); }
    if (axis.phases.phase() == AxisPhase::Fault) { return loop.refuse(order, FaultCode::InFault); }
    if (!loop.device.is_present()) { return loop.refuse(order, FaultCode::DeviceMissing); }
    axis.phases.clear_fault();
    axis.position.begin_homing();
    axis.phases.happen(AxisEvent::HomingBegins);
    const DeviceStatus& device = loop.device.status();
    take_homing_step(order.kind == AxisCommandKind::Approach ? homing_.approach(device.home)
                                                             : homing_.begin(device.home, device.position.count()),
                     loop);
}

void OwnMoves::move(const AxisCommand& order, bool is_resting, AxisLoop& loop) {
    const Position here = loop.condition.position.in_machine(loop.device.status().position);
    const std::int64_t steps = order.target_steps - here.count();
    const FaultCode why = refusal_of(order, steps, is_resting, loop);
    if (why != FaultCode::None) { return loop.refuse(order, why); }
    if (steps == 0) { return loop.condition.orders.end(FaultCode::None); }
    start({.steps = steps, .speed_mm_s = motor_.max_velocity_mm_s, .ticks = order.ticks}, 0, loop);
}

/// The motor goes from where its encoder shows it to where it should rest, at a speed to which it can jump: it has just
/// shown that its torque is short.
void OwnMoves::correct(const AxisCommand& order, bool is_resting, AxisLoop& loop) {
    AxisPosition& position = loop.condition.position;
    const DeviceStatus& device = loop.device.status();
    const std::int64_t lost = position.following_error(device);
    FaultCode why = refusal_of(order, lost, is_resting, loop);
    const bool is_there = position.in_machine(device.position).count() == order.target_steps;
    if (why == FaultCode::None && !is_there) { why = FaultCode::PositionMismatch; }
    if (why != FaultCode::None) { return loop.refuse(order, why); }
    if (lost == 0) { return loop.condition.orders.end(FaultCode::None); }
    position.take_over_encoder(device);
    loop.notice({AxisNotice::Kind::StepsCorrected, FaultCode::None, static_cast<std::uint64_t>(std::abs(lost))});
    start({.steps = -lost, .speed_mm_s = motor_.start_velocity_mm_s}, 0, loop);
}

FaultCode OwnMoves::refusal_of(const AxisCommand& order, std::int64_t steps, bool is_resting,
                               const AxisLoop& loop) const {
    if (!is_resting || loop.device.status().moving) { return FaultCode::Busy; }
    if (loop.condition.phases.has_fault()) { return FaultCode::InFault; }
    if (!loop.condition.is_ready()) { return FaultCode::NotHomed; }
    if (order.target_steps < limits_.min_steps || order.target_steps > limits_.max_steps) {
        return FaultCode::OutsideTravel;
    }
    const OwnMoveRequest request{std::max<std::int64_t>(1, std::abs(steps)), motor_.max_velocity_mm_s, order.ticks};
    const bool possible = OwnPieces::plan(motor_, tick_ns_, motor_.method, request, begin_steps_).has_value();
    return possible ? FaultCode::None : FaultCode::BadProgram;
}

void OwnMoves::jog(const AxisCommand& order, bool is_resting, AxisLoop& loop) {
    const FaultCode why = jog_refusal_of(order, is_resting, motor_, limits_, loop);
    if (why != FaultCode::None) { return loop.refuse(order, why); }
    const Position here = loop.condition.position.in_machine(loop.device.status().position);
    const std::int64_t steps = order.target_steps - here.count();
    if (steps == 0) { return loop.condition.orders.end(FaultCode::None); }
    const double fastest =
        loop.condition.position.homed() ? motor_.max_velocity_mm_s : motor_.unhomed_jog_mm_s.value_or(0);
    start_jog({.steps = steps, .speed_mm_s = std::min(order.speed_mm_s, fastest)}, order.until, loop);
}

/// Ends a jog here if its order runs out before the motion could begin. The owner orders it again while its client
/// renews it.
void OwnMoves::start_jog(const LocalMove& move, Tick until, AxisLoop& loop) {
    const Tick start = std::max(loop.now + jog_lead_, earliest_start(loop));
    if (std::min(until, loop.now + jog_hold_) < start + jog_frame_ * 2) {
        return loop.condition.orders.end(FaultCode::None);
    }
    const std::int64_t count = loop.device.status().position.count();
    const Position from = rest_position(count - loop.condition.position.zero_count(), move.steps < 0);
    auto pieces = OwnPieces::plan(motor_, tick_ns_, StepMethod::Ranade, {std::abs(move.steps), move.speed_mm_s}, {});
    OwnMove frames(std::move(*pieces), {from, move.steps < 0, std::abs(move.steps), start}, limits_,
                   {jog_frame_, lengths_.to_whole_step, lengths_.body_pieces});
    run_.emplace(move, std::move(frames), count + move.steps, 0, ahead_);
    run_->allow_until(std::min(until, loop.now + jog_hold_));
    between_steps_.reset();
    loop.begin_own_run(Trigger::None);
    feed(loop);
}

/// The order of a clock that is ahead does not hold longer than jog_hold_. An order from before a stall has run out.
void OwnMoves::renew(const AxisCommand& order, const AxisLoop& loop) {
    if (!run_ || !run_->is_jog() || order.sequence != loop.condition.orders.taken()) { return; }
    run_->allow_until(std::min(order.until, loop.now + jog_hold_));
}

/// Plans by the axis's method, or by Ranade's if homing is slower or longer than the method allows.
OwnMove OwnMoves::frames_of(const LocalMove& move, Position from, Tick start) const {
    const OwnMoveRequest request{std::abs(move.steps), move.speed_mm_s, move.ticks};
    auto pieces = OwnPieces::plan(motor_, tick_ns_, motor_.method, request, begin_steps_);
    if (!pieces) {
        pieces = OwnPieces::plan(motor_, tick_ns_, StepMethod::Ranade, {request.steps, move.speed_mm_s}, begin_steps_);
    }
    return OwnMove(std::move(*pieces), {from, move.steps < 0, request.steps, start}, limits_, lengths_);
}

/// A run that a switch or a halt ended between two steps may have ended right behind a pulse, but the next run starts
/// from the whole step. So it starts after the time of half a step.
Tick OwnMoves::earliest_start(const AxisLoop& loop) {
    const Position here = loop.device.status().position;
    if (rests_on_whole_step(here)) { return loop.now; }
    if (!between_steps_ || between_steps_->at != here) { between_steps_ = {here, loop.now + half_step_}; }
    return between_steps_->start;
}

void OwnMoves::start(const LocalMove& move, int tries, AxisLoop& loop) {
    const Tick start = std::max(loop.now, earliest_start(loop)) + slot_ * (2 + tries);
    const std::int64_t count = loop.device.status().position.count();
    const Position from = rest_position(count - loop.condition.position.zero_count(), move.steps < 0);
    run_.emplace(move, frames_of(move, from, start), count + move.steps, tries, ahead_);
    between_steps_.reset();
    loop.begin_own_run(move.trigger);
    feed(loop);
}

void OwnMoves::feed(AxisLoop& loop) {
    if (loop.condition.phases.has_fault() && !run_->is_halted()) { halt(loop); }
    run_->feed(loop);
}

void OwnMoves::halt(AxisLoop& loop) {
    if (!run_) { return loop.condition.orders.end(FaultCode::None); }
    run_->halt(loop);
}

void OwnMoves::end(AxisLoop& loop) {
    const OwnRun ended = *std::exchange(run_, std::nullopt);
    const DeviceStatus& device = loop.device.status();
    PhaseMachine& phases = loop.condition.phases;
    const bool parks = homing_.stage() == HomingStage::Park;
    if (ended.is_halted()) { homing_.abandon(); }
    if (device.stopped_by_trigger) { phases.happen(AxisEvent::SwitchStops); }
    if (device.stopped_by_limit) { phases.happen(AxisEvent::LimitStops); }
    if (ended.is_broken()) {
        homing_.abandon();
        return loop.fail(FaultCode::FrameBeyondLimits);
    }
    const auto rest = ended.is_jog() ? std::nullopt : ended.rest(device);
    if (rest) {
        const int tries = ended.tries_of_rest(device);
        return tries > kMaxTries ? loop.fail(FaultCode::DeviceFault) : start(*rest, tries, loop);
    }
    const bool is_homing = homing_stage() != HomingStage::Idle;
    if (parks || !is_homing) { phases.happen(AxisEvent::MotionEnds); }
    if (parks && ended.is_halted()) { lose_zero_outside_travel(limits_, loop); }
    if (!is_homing) { return end_order(loop); }
    take_homing_step(homing_.next({.by_trigger = device.stopped_by_trigger,
                                   .by_limit = device.stopped_by_limit,
                                   .home_closed = device.home,
                                   .count = device.position.count(),
                                   .trigger_count = device.trigger_count,
                                   .encoder_ahead = device.encoder_ahead()}),
                     loop);
}

void OwnMoves::abandon() {
    homing_.abandon();
    run_.reset();
}

void OwnMoves::take_homing_step(const HomingStep& step, AxisLoop& loop) {
    loop.notice({AxisNotice::Kind::HomingStage, step.fault, static_cast<std::uint64_t>(homing_.stage())});
    take_zero(step, loop);
    if (step.fault != FaultCode::None) {
        loop.condition.position.lose();
        return loop.fail(step.fault);
    }
    if (step.move && step.move->steps != 0) { return start(*step.move, 0, loop); }
    if (step.move) { return take_homing_step(homing_.next({.count = loop.device.status().position.count()}), loop); }
    if (step.done) {
        if (loop.condition.position.homed()) { loop.notice({AxisNotice::Kind::Homed, FaultCode::None, 0}); }
        loop.condition.orders.end(FaultCode::None);
    }
}

/// After a stop at the switch, sets the zero or continues the search.
void OwnMoves::take_zero(const HomingStep& step, AxisLoop& loop) {
    PhaseMachine& phases = loop.condition.phases;
    if (step.zeroed) {
        loop.condition.position.set_zero(step.zero_count, loop.device.status());
        phases.happen(AxisEvent::Zeroed);
    } else if (phases.phase() == AxisPhase::Stop && step.fault == FaultCode::None) {
        phases.happen(AxisEvent::HomingBegins);
    }
}

}  // namespace lockstep
