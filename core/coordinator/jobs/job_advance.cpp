#include "core/coordinator/jobs/job_advance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/coordinator/jobs/homing_job.hpp"
#include "core/coordinator/jobs/job_commands.hpp"
#include "core/coordinator/jobs/job_events.hpp"

namespace lockstep {
namespace {

/// An epoch came to rest by itself or by a client's hold or stop.
void settle_interrupted(activity::OnPath& path, const EpochEnd& end, JobLifecycle& jobs, CoordinatorLoop& loop) {
    PathTask& task = path.task;
    task.interrupt(end);
    if (path.intent == Intent::Hold) {
        activity::Holding holding{std::move(task), end.place, end.positions};
        return jobs.activity().become(MachineEvent::RestsOnPath, std::move(holding), loop.out);
    }
    EpochRunner& runner = jobs.path().runner();
    const bool lacks_blocks = runner.ending() == EpochRunner::Ending::LacksProgram || runner.source()->lacks_blocks();
    loop.notice({lacks_blocks ? CoordinatorNotice::Kind::ProgramLate : CoordinatorNotice::Kind::Interrupted,
                 lacks_blocks ? FaultCode::None : FaultCode::FrameLate, end.ran});
    if (runner.ending() == EpochRunner::Ending::Stuck) {
        return jobs.fail_at_rest({FaultCode::FrameBeyondLimits}, loop);
    }
    if (path.jog) { return jobs.end(JobOutcome::Stopped, loop); }  // it begins again while its key is held
    if (!lacks_blocks && !task.may_try_again(end)) { return jobs.fail_at_rest({FaultCode::FrameLate}, loop); }
    jobs.path().begin_epoch(task, end.place, end.positions, loop);
    jobs.follow(std::move(task), EpochBegun{}, std::move(path.pause), loop);
}

/// A whole leg was run.
void settle_complete(activity::OnPath& path, JobLifecycle& jobs, CoordinatorLoop& loop) {
    if (path.intent == Intent::Hold) {
        activity::Paused paused{std::move(path.task), {}, {}};
        paused.why = jobs.path().hold_behind_leg(paused.task);
        if (paused.why.wait) { paused.why.reason = PauseReason::Hold; }
        return jobs.activity().become(MachineEvent::Pauses, std::move(paused), loop.out);
    }
    const PathNext next = jobs.path().end_leg(path.task, loop, loop.out.events);
    jobs.follow(std::move(path.task), next, std::move(path.pause), loop);
}

/// After a touch, the job's line is the one at which the tool touched.
void fail_on_path(const activity::OnPath& path, const EpochEnd& end, JobLifecycle& jobs, PublishingLoop& loop) {
    const MachineFault fault = path.fault;
    const Block* const block = path.task.job.program->block(end.place.block);
    const auto line = block != nullptr ? block->line : std::nullopt;
    jobs.fail_at_rest(fault, loop);
    if (fault.code != FaultCode::TouchInMotion) { return; }
    jobs.count().cut(line, fault.code);
    jobs.count().end(JobOutcome::Failed);
}

/// Called when every axis is at rest after an epoch.
void settle(activity::OnPath& path, const EpochEnd& end, JobLifecycle& jobs, CoordinatorLoop& loop) {
    const bool may_end = end.rests_on_path() && path.intent < Intent::Stop;
    const auto probed = may_end ? jobs.path().end_probe(path.task, end, loop) : std::nullopt;
    loop.out.epoch_end = {end.kind, probed ? Intent::Stop : path.intent};
    jobs.path().end_epoch(path.task, end, loop, loop.out.events);
    if (path.intent == Intent::Abort) { return fail_on_path(path, end, jobs, loop); }
    if (probed) { return jobs.follow(std::move(path.task), *probed, {}, loop); }
    const bool is_held_return = path.intent == Intent::Hold && path.pause;
    const bool ends = path.intent == Intent::Stop || is_held_return;
    switch (end.kind) {
        case EpochEnd::Kind::FramesDiffer: return jobs.fail_at_rest({FaultCode::FramesDiffer, end.motor}, loop);
        case EpochEnd::Kind::Misplaced: return jobs.fail_at_rest({FaultCode::PositionMismatch, end.motor}, loop);
        case EpochEnd::Kind::OffTouch: return jobs.fail_at_rest({FaultCode::TouchMissed, end.motor}, loop);
        case EpochEnd::Kind::Interrupted:
            return ends ? jobs.end(JobOutcome::Stopped, loop) : settle_interrupted(path, end, jobs, loop);
        case EpochEnd::Kind::Complete:
            return ends ? jobs.end(JobOutcome::Stopped, loop) : settle_complete(path, jobs, loop);
    }
}

/// If the move ends otherwise than at its end or a touch, homing ends with it, unless it begins again.
void settle_homing_move(activity::OnPath& path, const EpochEnd& end, JobLifecycle& jobs, CoordinatorLoop& loop) {
    activity::Homing homing = *std::move(path.homing);
    const bool goes_on = path.intent == Intent::GoOn;
    const auto probed = goes_on && end.rests_on_path() ? jobs.path().end_probe(path.task, end, loop) : std::nullopt;
    if (goes_on && (probed || end.kind == EpochEnd::Kind::Complete)) {
        loop.out.epoch_end = {end.kind, probed ? Intent::Stop : Intent::GoOn};
        jobs.path().end_epoch(path.task, end, loop, loop.out.events);
        go_on_homing(homing, path.task, probed.has_value(), jobs, loop);
        return jobs.activity().become(MachineEvent::HomingBegins, std::move(homing), loop.out);
    }
    settle(path, end, jobs, loop);
    if (auto* const again = jobs.activity().as<activity::OnPath>()) {
        again->homing = std::move(homing);
    } else {
        const JobOutcome outcome = jobs.count().outcome().value_or(JobOutcome::Failed);
        loop.out.jobs.push_back(job_events::ended(homing.job, outcome));
    }
}

void advance_path(activity::OnPath& path, JobLifecycle& jobs, CoordinatorLoop& loop) {
    if (path.jog && path.intent == Intent::GoOn && path.jog->is_released(loop.now)) {
        brake_on_path(Intent::Stop, jobs, loop);
    }
    if (const auto end = jobs.path().advance(path.task, loop, loop.out)) {
        if (path.homing) { return settle_homing_move(path, *end, jobs, loop); }
        const auto next = path.jog ? path.jog->next(loop) : std::nullopt;
        const Tick renewed = path.jog ? path.jog->renewed() : Tick{};
        settle(path, *end, jobs, loop);
        const MachineActivity& activity = jobs.activity();
        const bool is_free = activity.is<activity::Idle>() || activity.is<activity::Paused>();
        if (next && is_free) { (void)commands::begin_path_jog(*next, renewed, jobs, loop); }
        return;
    }
    if (!jobs.path().runner().is_overdue() || jobs.path().probing().waits()) { return; }
    const auto homing = path.homing;
    // The fault names an axis that does not come to rest.
    jobs.fail({FaultCode::NotAtRest, loop.axes.moving(loop.slot).value_or(MotorIndex{})}, loop);
    jobs.fail_at_rest(path.fault, loop);
    if (homing) { loop.out.jobs.push_back(job_events::ended(homing->job, JobOutcome::Failed)); }
}

/// The motors that the job ordered to a place. `targets`: where they must be, if the job was not stopped.
void settle_alone(MotorSet motors, const OwnTargets* targets, JobLifecycle& jobs, CoordinatorLoop& loop) {
    const Intent intent = jobs.activity().intent();
    if (intent == Intent::Abort) { return jobs.fail_at_rest(jobs.activity().fault(), loop); }
    for (const MotorIndex m : motors) {
        if (!loop.axes.state(m)) { continue; }
        const AxisState& state = *loop.axes.state(m);
        if (state.command_fault != FaultCode::None) { return jobs.fail({state.command_fault, m}, loop); }
        if (targets == nullptr || intent != Intent::GoOn) { continue; }
        if (state.position.count() != targets->target(m)) { return jobs.fail({FaultCode::PositionMismatch, m}, loop); }
    }
    jobs.end(intent == Intent::GoOn ? JobOutcome::Done : JobOutcome::Stopped, loop);
}

bool are_orders_done(const CoordinatorLoop& loop) {
    for (const MotorIndex m : motor_indices(loop.axes.size())) {
        if (loop.axes.is_present(m, loop.slot) && !loop.is_order_done(m)) { return false; }
    }
    return true;
}

Subticks into_path(const MadeFrames& made, Tick now) {
    if (!made.start()) { return {}; }
    return subticks(std::clamp(now - *made.start(), Ticks{}, made.ticks_of(made.newest())));
}

}  // namespace

void advance_job(JobLifecycle& jobs, CoordinatorLoop& loop) {
    MachineActivity& activity = jobs.activity();
    if (auto* const path = activity.as<activity::OnPath>()) { return advance_path(*path, jobs, loop); }
    if (!activity.in_motion()) { return; }
    auto* const homing = activity.as<activity::Homing>();
    if (homing != nullptr && homing->intent == Intent::GoOn) { return advance_homing(*homing, jobs, loop); }
    if (!are_orders_done(loop)) { return; }
    if (homing != nullptr) {
        return settle_alone(loop.kinematics.motors_of_axes(homing->sequence.axes()), nullptr, jobs, loop);
    }
    if (const auto* const moves = activity.as<activity::OwnMoves>()) {
        // A job goes on from where all motors rested, also those that had lost no steps.
        const MotorSet placed = is_correcting(activity) ? MotorSet::first(loop.axes.size()) : moves->targets.motors();
        return settle_alone(placed, &moves->targets, jobs, loop);
    }
    if (!activity.is_jogging() || activity.as<activity::Jogging>()->jogs.none()) {
        settle_alone({}, nullptr, jobs, loop);
    }
}

void advance_jogs(JobLifecycle& jobs, CoordinatorLoop& loop) {
    auto* const jogging = jobs.activity().as<activity::Jogging>();
    if (jogging == nullptr) { return; }
    const auto refused = jogging->jogs.advance(loop, loop.orders, loop.out.axis_commands);
    if (refused) { jobs.fail({loop.axes.state(*refused)->command_fault, *refused}, loop); }
}

void note_progress(JobLifecycle& jobs, const LoopView& loop) {
    auto* const path = jobs.activity().as<activity::OnPath>();
    if (path == nullptr) { return; }
    const MadeFrames& made = jobs.path().runner().made();
    const PathPlace here = made.place_at(loop.now);
    const double ticks = jobs.path().seconds_left(here) * loop.machine.ticks_per_second();
    path->task.progress.note(into_path(made, loop.now), subticks(Ticks{std::llround(ticks)}));
    path->task.job.program->release_before(here.block);
}

}  // namespace lockstep
