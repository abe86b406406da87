#include "core/coordinator/jobs/job_runner.hpp"

#include <utility>

#include "core/check.hpp"

namespace lockstep {
namespace {

/// The number of a notice; 0 without a line.
std::uint64_t number_of(std::optional<std::int32_t> line) { return static_cast<std::uint64_t>(line.value_or(0)); }

}  // namespace

void JobRunner::advance(CoordinatorLoop& loop) {
    if (path_.is_moving()) { return advance_path(loop); }
    if (loop.condition.phase() == MachinePhase::Homing) { return advance_homing(loop); }
    if (axes_move_alone()) { advance_alone(loop); }
}

void JobRunner::advance_path(CoordinatorLoop& loop) {
    if (const auto end = path_.advance(loop)) { return settle(*end, loop); }
    if (path_.is_overdue()) { give_up_epoch(loop); }
}

void JobRunner::home_next_group(CoordinatorLoop& loop) {
    const AxisSet group = homing_.next_group(loop.machine);
    if (group == 0) { return end(JobOutcome::Done, loop); }
    for (std::size_t i = 0; i < loop.axes.size(); ++i) {
        if (has_axis(group, i)) { (void)loop.order(i, AxisCommandKind::Home); }
    }
}

void JobRunner::advance_homing(CoordinatorLoop& loop) {
    for (std::size_t i = 0; i < loop.axes.size(); ++i) {
        if (!loop.is_order_done(i)) { return; }
        const auto& order = loop.orders.newest(i);
        const auto& state = loop.axes.state(i);
        const bool refused = order && state && state->command_fault != FaultCode::None;
        if (refused && order->kind == AxisCommandKind::Home) { return fail(state->command_fault, i, loop); }
    }
    home_next_group(loop);
}

void JobRunner::advance_alone(CoordinatorLoop& loop) {
    const AxisSet axes = job_->kind == JobKind::Home ? homing_.axes() : has_jog() ? 0 : own_.axes();
    for (std::size_t i = 0; i < loop.axes.size(); ++i) {
        if (loop.axes.is_present(i, loop.slot) && !loop.is_order_done(i)) { return; }
    }
    if (intent_ == Intent::Abort) { return end_failed(loop); }
    if (is_jogging() && !jogs_.none()) { return; }
    for (std::size_t i = 0; i < loop.axes.size(); ++i) {
        if (!has_axis(axes, i) || !loop.axes.state(i)) { continue; }
        const AxisState& state = *loop.axes.state(i);
        if (state.command_fault != FaultCode::None) { return fail(state.command_fault, i, loop); }
        if (intent_ != Intent::GoOn) { continue; }
        if (state.position.count() != own_.target(i)) { return fail(FaultCode::PositionMismatch, i, loop); }
    }
    end(intent_ == Intent::Stop ? JobOutcome::Stopped : JobOutcome::Done, loop);
}

void JobRunner::advance_jogs(CoordinatorLoop& loop) {
    if (!has_jog()) { return; }
    const auto refused = jogs_.advance(loop);
    if (refused) { fail(loop.axes.state(*refused)->command_fault, *refused, loop); }
}

/// Orders a halt to each axis that moves by itself. An axis that was ordered an emergency stop before keeps this order
/// as its newest one.
void JobRunner::halt_alone(CoordinatorLoop& loop) {
    jogs_.release_all();
    for (std::size_t i = 0; i < loop.axes.size(); ++i) {
        const bool moves = loop.orders.is_open(i, AxisCommandKind::MoveOwn, loop.axes) ||
                           loop.orders.is_open(i, AxisCommandKind::Home, loop.axes) ||
                           loop.orders.is_open(i, AxisCommandKind::Jog, loop.axes);
        if (moves) { (void)loop.order(i, AxisCommandKind::Halt); }
    }
}

/// Called when every axis is at rest after an epoch.
void JobRunner::settle(const EpochEnd& end_of_epoch, CoordinatorLoop& loop) {
    loop.out.epoch_end = {end_of_epoch.kind, intent_};
    path_.end_epoch(end_of_epoch, loop);
    if (intent_ == Intent::Abort) { return end_failed(loop); }
    switch (end_of_epoch.kind) {
        case EpochEnd::Kind::FramesDiffer: return fail(FaultCode::FramesDiffer, end_of_epoch.axis, loop);
        case EpochEnd::Kind::Misplaced: return fail(FaultCode::PositionMismatch, end_of_epoch.axis, loop);
        case EpochEnd::Kind::Interrupted: return interrupted(end_of_epoch, loop);
        case EpochEnd::Kind::Complete: break;
    }
    if (intent_ == Intent::Stop) { return end(JobOutcome::Stopped, loop); }
    if (intent_ == Intent::GoOn) { return follow(path_.end_leg(loop), loop); }
    if (returns()) { return end(JobOutcome::Stopped, loop); }
    path_.hold_behind_leg();
    loop.enter(MachinePhase::Paused);
}

void JobRunner::interrupted(const EpochEnd& end_of_epoch, CoordinatorLoop& loop) {
    path_.interrupt(end_of_epoch);
    if (intent_ == Intent::Stop) { return end(JobOutcome::Stopped, loop); }
    if (intent_ == Intent::Hold && returns()) { return end(JobOutcome::Stopped, loop); }
    if (intent_ == Intent::Hold) { return loop.enter(MachinePhase::Holding); }
    const bool lacks_blocks = path_.waits_for_blocks();
    loop.notice({lacks_blocks ? CoordinatorNotice::Kind::ProgramLate : CoordinatorNotice::Kind::Interrupted,
                 lacks_blocks ? FaultCode::None : FaultCode::FrameLate, end_of_epoch.ran});
    if (path_.is_stuck()) { return fail(FaultCode::FrameBeyondLimits, 0, loop); }
    if (!lacks_blocks && !path_.may_try_again(end_of_epoch)) { return fail(FaultCode::FrameLate, 0, loop); }
    follow(path_.go_on(loop), loop);
}

/// The fault names an axis that does not come to rest.
void JobRunner::give_up_epoch(CoordinatorLoop& loop) {
    fail(FaultCode::NotAtRest, loop.axes.moving(loop.slot).value_or(0), loop);
    path_.give_up_epoch();
    end_failed(loop);
}

void JobRunner::follow(PathJob::Next next, CoordinatorLoop& loop) {
    switch (next) {
        case PathJob::Next::Moves: intent_ = Intent::GoOn; return;
        case PathJob::Next::Pauses: return loop.enter(MachinePhase::Paused);
        case PathJob::Next::IsDone: return end_program(loop);
    }
}

/// Ends the job where its program ends, or where the program was cut.
void JobRunner::end_program(CoordinatorLoop& loop) {
    const auto& cut = job_->program->cut();
    if (!cut) { return end(JobOutcome::Done, loop); }
    const std::optional<std::int32_t> line = job_->program->last_line();
    end(JobOutcome::Stopped, loop);
    count_.cut(line, cut->why);
    loop.notice({CoordinatorNotice::Kind::ProgramCut, cut->why, number_of(line)});
}

void JobRunner::end(JobOutcome outcome, CoordinatorLoop& loop) {
    if (!job_) { return; }
    if (is_in_pause()) { return end_in_pause(outcome, loop); }
    if (outcome != JobOutcome::Done) { path_.events().switch_off(job_->number, loop); }
    loop.out.jobs.push_back({.kind = JobEvent::Kind::Ended,
                             .job = job_->number,
                             .job_kind = job_->kind,
                             .outcome = outcome,
                             .program_id = job_->program_id});
    job_.reset();
    count_.end(outcome);
    loop.enter(MachinePhase::Idle);
}

/// The paused job waits again, or goes on after a whole return. A return that is stopped, and a failure, end it as
/// well.
void JobRunner::end_in_pause(JobOutcome outcome, CoordinatorLoop& loop) {
    const bool was_return = returns();
    const bool ends_all = outcome == JobOutcome::Failed || (was_return && intent_ == Intent::Stop);
    loop.out.jobs.push_back(
        {.kind = JobEvent::Kind::Ended, .job = job_->number, .job_kind = job_->kind, .outcome = outcome});
    job_ = std::exchange(paused_, std::nullopt);
    path_.take_up();
    intent_ = Intent::GoOn;
    if (ends_all) { return end(outcome, loop); }
    if (was_return && outcome == JobOutcome::Done) { return follow(path_.begin_leg(loop), loop); }
    loop.enter(MachinePhase::Paused);
}

void JobRunner::end_failed(CoordinatorLoop& loop) {
    end(JobOutcome::Failed, loop);
    loop.enter(MachinePhase::Fault);
}

void JobRunner::fail(FaultCode fault, std::size_t axis, CoordinatorLoop& loop) {
    if (!loop.condition.latch(fault, axis, loop.out.notices)) { return; }
    if (in_motion()) {
        intent_ = Intent::Abort;
        path_.is_moving() ? path_.stop(loop.next_state) : halt_alone(loop);
        return loop.enter(MachinePhase::Stopping);
    }
    doubt_inherited(loop);
    end_failed(loop);
}

void JobRunner::lose_client(Identity client, CoordinatorLoop& loop) {
    if (client_ != client) { return; }
    client_.reset();
    if (!path_.is_moving() || intent_ != Intent::GoOn) { return; }
    const bool is_held = loop.machine.unattended_job == UnattendedJob::IsHeld;
    if (is_held) { (void)interrupt(Intent::Hold, loop); }
    loop.notice({is_held ? CoordinatorNotice::Kind::UnattendedHeld : CoordinatorNotice::Kind::UnattendedRunsOn,
                 FaultCode::None, job_->number});
}

void JobRunner::take_over(const std::optional<MachineState>& last, CoordinatorLoop& loop) {
    if (!last || last->job < count_.number()) { return; }
    count_.inherit(*last);
    path_.inherit(last->overrides);
    path_.events().inherit(last->devices);
    if (last->job == 0 || last->outcome) { return; }
    inherited_.begin(*last);
    if (const auto doubt = inherited_.doubt(loop)) { cut_inherited(*doubt, loop); }
}

void JobRunner::go_on_with_inherited(CoordinatorLoop& loop) {
    if (!inherited_.exists()) { return; }
    const MachineState& last = inherited_.last();
    const auto program = last.program ? loop.programs.find(*last.program) : nullptr;
    check(program != nullptr, "the program of an inherited job is known");
    if (!is_at_hand(last, *program)) { return; }
    const auto rest = inherited_.rest(*program, loop);
    if (!rest) { return cut_inherited(rest.error(), loop); }
    loop.notice({CoordinatorNotice::Kind::JobContinued, FaultCode::None, number_of(last.line)});
    job_ = MachineJob{.number = count_.number(), .kind = last.job_kind, .program_id = last.program, .program = program};
    path_.load(*job_, *rest, last.progress, last.events_from);
    inherited_.end();
    follow(path_.go_on(loop), loop);
}

void JobRunner::cut_inherited(TakeoverDoubt doubt, CoordinatorLoop& loop) {
    if (!inherited_.exists()) { return; }
    count_.cut(inherited_.last().line);
    inherited_.end();
    path_.events().switch_off(count_.number(), loop);
    loop.notice({CoordinatorNotice::Kind::JobCutShort, FaultCode::None, number_of(count_.line()), doubt});
}

void JobRunner::drop(CoordinatorLoop& loop) {
    end(JobOutcome::Stopped, loop);
    cut_inherited(TakeoverDoubt::Interrupted, loop);
}

void JobRunner::stand_down() {
    if (job_) { count_.end(JobOutcome::Stopped); }
    job_.reset();
    paused_.reset();
    inherited_.forget();
    path_.give_up_epoch();
    jogs_.release_all();
    intent_ = Intent::GoOn;
}

/// Reuses the memory of the last state's pause.
void JobRunner::report_pause(MachineState& state, const CoordinatorLoop& loop) const {
    if (!is_in_pause() && !is_paused(loop)) { return state.pause.reset(); }
    if (!state.pause) { state.pause.emplace(); }
    state.pause->why = path_.pause();
    state.pause->place = path_.place();
}

void JobRunner::report(MachineState& state, const CoordinatorLoop& loop) const {
    state.job = count_.number();
    state.outcome = has_any() ? std::nullopt : count_.outcome();
    state.job_begun = count_.begun_in();
    state.line = count_.line();
    state.job_fault = count_.fault();
    path_.report_epoch(state);
    report_pause(state, loop);
    if (job_ && job_->kind == JobKind::MoveOwn) {
        state.progress = own_.progress(loop.axes);
        state.remaining_s = own_.remaining_s(loop.now, loop.machine);
    }
    if (inherited_.exists()) {
        state.line = inherited_.last().line;
        state.progress = inherited_.last().progress;
    }
    if (state.phase == MachinePhase::Holding) { path_.report_held(state); }
    if (state.phase == MachinePhase::Paused) { path_.report_paused(state); }
    if (!path_.is_moving()) { return; }
    path_.report_progress(state);
    if (intent_ == Intent::GoOn) { path_.report_rests(state, loop.axes); }
}

}  // namespace lockstep
