#include "core/coordinator/jobs/inherited_job.hpp"

#include <utility>

#include "core/check.hpp"

namespace lockstep {

void Inheritance::take_over(const std::optional<MachineState>& last, JobLifecycle& jobs, PublishingLoop& loop) const {
    const std::optional<Slot> interrupted = jobs.activity().as<activity::Standby>()->interrupted;
    activity::Waiting waiting;
    if (last && last->job >= jobs.count().number()) {
        jobs.count().inherit(*last);
        jobs.path().set_overrides(last->overrides);
        jobs.path().events().inherit(last->devices);
        if (last->job != 0 && !last->outcome) { waiting.inherited = last; }
    }
    jobs.activity().become(MachineEvent::Claimed, std::move(waiting), loop.out);
    const MachineState* const inherited = jobs.activity().inherited();
    if (inherited == nullptr) { return; }
    if (const auto why = doubt(*inherited, interrupted, loop)) { jobs.cut_inherited(*why, loop); }
}

/// Returns why the job cannot be continued, as far as that is known before all axes follow.
std::optional<TakeoverDoubt> Inheritance::doubt(const MachineState& last, std::optional<Slot> interrupted,
                                                const LoopView& loop) const {
    if (on_takeover_ != OnTakeover::Continue) { return TakeoverDoubt::NotAsked; }
    if (!last.program) { return TakeoverDoubt::NotRunning; }
    const bool is_late = interrupted && *interrupted + rules::kHopSlots >= last.stamp;
    if (is_late) { return TakeoverDoubt::Interrupted; }
    if (!loop.programs.find(*last.program)) { return TakeoverDoubt::UnknownProgram; }
    if (last.config_hash != config_hash_) { return TakeoverDoubt::OtherPlan; }
    return loop.axes.missing(loop.slot) ? std::optional(TakeoverDoubt::AxisInDoubt) : std::nullopt;
}

void Inheritance::leave_waiting(JobLifecycle& jobs, CoordinatorLoop& loop) {
    MachineActivity& activity = jobs.activity();
    if (activity.inherited() == nullptr) {
        return activity.become(MachineEvent::AxesReady, activity::Idle{}, loop.out);
    }
    const MachineState& last = *activity.inherited();
    const auto program = last.program ? loop.programs.find(*last.program) : nullptr;
    check(program != nullptr, "the program of an inherited job is known");
    if (!is_at_hand(last, *program)) { return; }
    const auto rest = rest_of_job(last, *program, loop.machine, loop.axes.views());
    if (!rest) {
        jobs.cut_inherited(rest.error(), loop);
        return activity.become(MachineEvent::AxesReady, activity::Idle{}, loop.out);
    }
    const auto line = static_cast<std::uint64_t>(last.line.value_or(0));
    loop.notice({CoordinatorNotice::Kind::JobContinued, FaultCode::None, line});
    PathTask task{.job = {.number = jobs.count().number(),
                          .kind = last.job_kind,
                          .program_id = last.program,
                          .program = program,
                          .client = {}},
                  .next = rest->first,
                  .from = rest->from,
                  .progress = PathProgress(last.progress)};
    const PathNext next = jobs.path().continue_rest(task, *rest, last.events_from, loop, loop.out.events);
    jobs.follow(std::move(task), next, {}, loop);
}

}  // namespace lockstep
