#include "core/coordinator/jobs/job_lifecycle.hpp"

#include <cmath>
#include <utility>

#include "core/coordinator/jobs/job_events.hpp"

namespace lockstep {
namespace {

/// The number of a notice; 0 without a line.
std::uint64_t number_of(std::optional<std::int32_t> line) { return static_cast<std::uint64_t>(line.value_or(0)); }

/// Records the begin of a job in the pause of another one.
MachineJob begin_aside(const MachineJob& paused, JobKind kind, std::shared_ptr<const KnownProgram> program,
                       const AxisCounts& start, JobCount& count, PublishingLoop& loop) {
    const MachineJob job{.number = count.begin_in_pause(),
                         .kind = kind,
                         .program_id = {},
                         .program = std::move(program),
                         .client = paused.client};
    loop.out.jobs.push_back(job_events::begun(job, start, loop.plays()));
    return job;
}

}  // namespace

MachineJob JobLifecycle::begin(JobKind kind, const Command& command, std::shared_ptr<const KnownProgram> program,
                               const AxisCounts& start, PublishingLoop& loop) {
    const bool is_path = kind == JobKind::Run || kind == JobKind::Move;
    const MachineJob job{.number = count_.begin(loop.term),
                         .kind = kind,
                         .program_id = is_path ? std::optional(command.program) : std::nullopt,
                         .program = std::move(program),
                         .client = command.client};
    loop.out.jobs.push_back(job_events::begun(job, start, loop.plays()));
    return job;
}

MachineJob JobLifecycle::begin_in_pause(JobKind kind, std::shared_ptr<const KnownProgram> program,
                                        const AxisCounts& start, PublishingLoop& loop) {
    const MachineJob& paused = check_found(activity_.job(), "a job in a pause begins while another one pauses");
    return begin_aside(paused, kind, std::move(program), start, count_, loop);
}

void JobLifecycle::follow(PathTask task, const PathNext& next, std::optional<activity::Paused> pause,
                          CoordinatorLoop& loop) {
    if (std::holds_alternative<EpochBegun>(next)) {
        activity::OnPath moving{{}, std::move(task), std::move(pause)};
        return activity_.become(MachineEvent::EpochBegins, std::move(moving), loop.out);
    }
    if (const Pause* const why = std::get_if<Pause>(&next)) { return this->pause({std::move(task), *why, {}}, loop); }
    if (const Probed* const end = std::get_if<Probed>(&next)) {
        loop.out.jobs.push_back(job_events::probed(task, path_));
        if (end->why == FaultCode::None) { return finish(task.job, JobOutcome::Done, loop); }
        return end_early(task.job, task.job.program->last_line(), end->why, loop);
    }
    if (pause) { return end_in_pause(task.job, *std::move(pause), JobOutcome::Done, loop); }
    const KnownProgram& program = *task.job.program;
    if (program.cut()) { return end_early(task.job, program.last_line(), program.cut()->why, loop); }
    finish(task.job, JobOutcome::Done, loop);
}

void JobLifecycle::pause(activity::Paused paused, PublishingLoop& loop) {
    if (const auto& wait = paused.why.wait) {
        const Ticks limit{std::llround(wait->seconds * loop.machine.ticks_per_second())};
        paused.why.reason = PauseReason::Input;
        paused.watch.emplace(wait->mode, loop.slot, loop.now + limit);
    }
    activity_.become(MachineEvent::Pauses, std::move(paused), loop.out);
}

/// To make up lost steps is a job in the pause of the one that goes on. It does not wait again for an input that it has
/// waited for.
void JobLifecycle::go_on(activity::Paused paused, CoordinatorLoop& loop) {
    const OwnTargets lost = OwnTargets::of_lost_steps(loop);
    if (lost.motors().empty()) {
        const PathNext next = path_.begin_leg(paused.task, loop, loop.out.events);
        return follow(std::move(paused.task), next, {}, loop);
    }
    lost.order(loop.orders, loop.term);
    paused.why = {.reason = PauseReason::Hold};
    paused.watch.reset();
    const MachineJob job = begin_aside(paused.task.job, JobKind::Return, nullptr, lost.from(), count_, loop);
    activity_.become(MachineEvent::OwnMovesBegin, activity::OwnMoves{{}, job, lost, std::move(paused)}, loop.out);
}

void JobLifecycle::end(JobOutcome outcome, CoordinatorLoop& loop) {
    const MachineJob job = check_found(activity_.job(), "a job that ends exists");
    activity::Paused* const pause = activity_.pause();
    pause != nullptr ? end_in_pause(job, std::move(*pause), outcome, loop) : finish(job, outcome, loop);
}

void JobLifecycle::note_end(const MachineJob& job, JobOutcome outcome, PublishingLoop& loop) {
    if (outcome != JobOutcome::Done) { path_.events().switch_off(job.number, outcome, loop, loop.out.events); }
    loop.out.jobs.push_back(job_events::ended(job, outcome));
    count_.end(outcome);
}

void JobLifecycle::finish(const MachineJob& job, JobOutcome outcome, PublishingLoop& loop) {
    note_end(job, outcome, loop);
    activity_.become(MachineEvent::JobEnds, activity::Idle{}, loop.out);
}

/// The paused job waits again, or goes on after a whole return. A return that is stopped ends it as well.
void JobLifecycle::end_in_pause(const MachineJob& job, activity::Paused pause, JobOutcome outcome,
                                CoordinatorLoop& loop) {
    loop.out.jobs.push_back(job_events::ended(job, outcome));
    pause.task.job.client = job.client;
    const bool is_return = job.kind == JobKind::Return;
    if (is_return && activity_.intent() == Intent::Stop) { return finish(pause.task.job, outcome, loop); }
    if (!is_return || outcome != JobOutcome::Done) {
        return activity_.become(MachineEvent::Pauses, std::move(pause), loop.out);
    }
    pause.why.wait ? this->pause(std::move(pause), loop) : go_on(std::move(pause), loop);
}

void JobLifecycle::end_early(const MachineJob& job, std::optional<std::int32_t> line, FaultCode why,
                             PublishingLoop& loop) {
    finish(job, JobOutcome::Stopped, loop);
    count_.cut(line, why);
    loop.notice({CoordinatorNotice::Kind::ProgramCut, why, number_of(line)});
}

void JobLifecycle::fail(const MachineFault& fault, CoordinatorLoop& loop) {
    if (activity_.has_fault()) { return; }
    if (!activity_.in_motion()) { return fail_at_rest(fault, loop); }
    loop.notice({CoordinatorNotice::Kind::Fault, fault.code, fault.motor});
    activity_.is<activity::OnPath>() ? path_.runner().stop(loop.next_state) : halt_axes(activity_, loop);
    activity_.abort(fault, loop.out);
}

void JobLifecycle::fail_at_rest(const MachineFault& fault, PublishingLoop& loop) {
    const MachineFault first = activity_.has_fault() ? activity_.fault() : fault;
    if (!activity_.has_fault()) { loop.notice({CoordinatorNotice::Kind::Fault, fault.code, fault.motor}); }
    cut_inherited(TakeoverDoubt::AxisInDoubt, loop);
    const MachineJob* const job = activity_.job();
    const activity::Paused* const pause = activity_.pause();
    if (pause != nullptr) { loop.out.jobs.push_back(job_events::ended(*job, JobOutcome::Failed)); }
    if (job != nullptr) { note_end(pause != nullptr ? pause->task.job : *job, JobOutcome::Failed, loop); }
    path_.events().switch_off_outputs(count_.number(), JobOutcome::Failed, loop, loop.out.events);
    activity_.become(MachineEvent::Fails, activity::InFault{first}, loop.out);
}

void JobLifecycle::cut_inherited(TakeoverDoubt doubt, PublishingLoop& loop) {
    if (activity_.inherited() == nullptr) { return; }
    count_.cut(activity_.inherited()->line);
    activity_.as<activity::Waiting>()->inherited.reset();
    path_.events().switch_off(count_.number(), JobOutcome::Failed, loop, loop.out.events);
    loop.notice({CoordinatorNotice::Kind::JobCutShort, FaultCode::None, number_of(count_.line()), doubt});
}

void JobLifecycle::stand_down(PublishingLoop& loop) {
    if (activity_.job() != nullptr) { count_.end(JobOutcome::Stopped); }
    activity_.become(MachineEvent::StoodDown, activity::Standby{}, loop.out);
}

void brake_on_path(Intent intent, JobLifecycle& jobs, PublishingLoop& loop) {
    jobs.path().runner().stop(loop.next_state);
    jobs.activity().bring_to_rest(intent, loop.out);
}

/// An axis that was ordered an emergency stop before keeps this order as its newest one.
void halt_axes(MachineActivity& activity, CoordinatorLoop& loop) {
    if (auto* const jogging = activity.as<activity::Jogging>()) { jogging->jogs.release_all(); }
    for (const MotorIndex m : motor_indices(loop.axes.size())) {
        const bool moves = loop.orders.is_open(m, AxisCommandKind::MoveOwn, loop.axes) ||
                           loop.orders.is_open(m, AxisCommandKind::Home, loop.axes) ||
                           loop.orders.is_open(m, AxisCommandKind::Approach, loop.axes) ||
                           loop.orders.is_open(m, AxisCommandKind::Correct, loop.axes) ||
                           loop.orders.is_open(m, AxisCommandKind::Jog, loop.axes);
        if (moves) { (void)loop.order(m, AxisCommandKind::Halt); }
    }
}

}  // namespace lockstep
