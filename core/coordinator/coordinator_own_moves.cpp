// Moves of axes each by itself: the coordinator orders them and waits; it makes no frames. What an axis is asked is
// planned here too, so that a person is told what cannot be.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/axis/own_moves/own_pieces.hpp"
#include "core/coordinator/coordinator.hpp"
#include "core/motion/ideal.hpp"

namespace lockstep {

/// The targets are where the program ends, whatever line it takes there.
Reply Coordinator::move_own(const Command& command, CoordinatorOutputs& out) {
    if (auto refusal = refuse_unless_ready(command)) { return *refusal; }
    const auto program = programs_.find(command.program);
    if (program == programs_.end()) {
        return refused(command, FaultCode::UnknownProgram, "the program has not arrived whole");
    }
    const auto plan = planner_.plan(*program->second, counts());
    if (!plan) { return refused(command, plan.error().fault, plan.error().text); }
    Job job{.number = jobs_ + 1, .kind = JobKind::MoveOwn, .program = program->second, .begun = now_};
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const bool moves = !plan->empty() && !plan->back().moves.empty();
        job.from.push_back(views_[i].state->position.count());
        job.to.push_back(moves ? plan->back().moves.back().to[i] : job.from[i]);
        const std::int64_t steps = std::abs(job.to[i] - job.from[i]);
        if (steps == 0) { continue; }
        job.axes |= axis_bit(i);
        if (auto refusal = refuse_own(command, i, steps)) { return *refusal; }
        job.planned_s = std::max(job.planned_s, planned_seconds(i, steps, command.ticks));
    }
    begin_own(std::move(job), command.ticks, out);
    return accepted(command);
}

std::optional<Reply> Coordinator::refuse_own(const Command& command, std::size_t axis, std::int64_t steps) const {
    const AxisConfig& config = machine_.axes[axis];
    if (!views_[axis].state->homed) {
        return refused(command, FaultCode::NotHomed, "axis " + config.name + " is not homed");
    }
    const OwnMoveRequest move{steps, config.max_velocity_mm_s, command.ticks};
    const auto pieces = OwnPieces::plan(config, machine_.tick_ns, config.method, move, begin_steps_);
    return pieces ? std::nullopt : std::optional(refused(command, FaultCode::BadProgram, pieces.error()));
}

/// As asked, or as the continuous ideal has it: methods differ from that by what they round.
double Coordinator::planned_seconds(std::size_t axis, std::int64_t steps, Ticks asked) const {
    if (asked > Ticks{}) { return static_cast<double>(asked.value) / machine_.ticks_per_second(); }
    const AxisConfig& config = machine_.axes[axis];
    return Ideal(step_move_of(config, {steps, config.max_velocity_mm_s})).duration_s();
}

void Coordinator::begin_own(Job job, Ticks ticks, CoordinatorOutputs& out) {
    jobs_ = job.number;
    job_begun_ = ownership_.term();
    job_ = std::move(job);
    intent_ = Intent::GoOn;
    out.jobs.push_back({.kind = JobEvent::Kind::Begun,
                        .job = job_->number,
                        .job_kind = job_->kind,
                        .program = job_->program,
                        .program_id = job_->program_id,
                        .start_counts = job_->from});
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!has_axis(job_->axes, i)) { continue; }
        order(i, AxisCommandKind::MoveOwn);
        orders_[i]->target_steps = job_->to[i];
        orders_[i]->ticks = ticks;
    }
    enter(MachinePhase::Running, out);
}

/// Homing cannot go on from where it was held: a hold ends it as a stop does.
Reply Coordinator::interrupt_own(const Command& command, Intent intent, CoordinatorOutputs& out) {
    if (intent == Intent::Hold && in_own_move()) {
        return refused(command, FaultCode::Busy,
                       "moves of axes on their own cannot be held and resumed; stop them: lockstep stop");
    }
    intent_ = std::max(intent_, Intent::Stop);
    halt_own();
    enter(MachinePhase::Stopping, out);
    return accepted(command);
}

/// An emergency stop ordered before stays the last word.
void Coordinator::halt_own() {
    for (std::size_t i = 0; i < orders_.size(); ++i) {
        if (order_done(i)) { continue; }
        const AxisCommandKind kind = orders_[i]->kind;
        if (kind == AxisCommandKind::MoveOwn || kind == AxisCommandKind::Home) { order(i, AxisCommandKind::Halt); }
    }
}

void Coordinator::advance_own(CoordinatorOutputs& out) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (present(i) && !order_done(i)) { return; }
    }
    for (std::size_t i = 0; i < views_.size() && intent_ != Intent::Abort; ++i) {
        if (!has_axis(job_->axes, i) || !views_[i].state) { continue; }
        const AxisState& state = *views_[i].state;
        if (state.command_fault != 0) { return fail(static_cast<FaultCode>(state.command_fault), i, out); }
        if (intent_ != Intent::GoOn) { continue; }
        if (state.position.count() != job_->to[i]) { return fail(FaultCode::PositionMismatch, i, out); }
    }
    if (intent_ == Intent::Abort) {
        end_job(JobOutcome::Failed, out);
        return enter(MachinePhase::Fault, out);
    }
    end_job(intent_ == Intent::Stop ? JobOutcome::Stopped : JobOutcome::Done, out);
}

/// The axis that has the most before it counts.
void Coordinator::say_progress_of_own(MachineState& state) const {
    state.progress = 1;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!has_axis(job_->axes, i) || !views_[i].state) { continue; }
        const auto gone = static_cast<double>(views_[i].state->position.count() - job_->from[i]);
        const auto way = static_cast<double>(job_->to[i] - job_->from[i]);
        state.progress = std::min(state.progress, std::clamp(gone / way, 0.0, 1.0));
    }
    const double gone_s = static_cast<double>((now_ - job_->begun).value) / machine_.ticks_per_second();
    state.remaining_s = std::max(0.0, job_->planned_s - gone_s);
}

}  // namespace lockstep
