// How jobs begin and end, and what the machine does meanwhile.
#pragma once

#include <memory>
#include <optional>

#include "core/coordinator/jobs/activity.hpp"
#include "core/coordinator/jobs/job.hpp"
#include "core/coordinator/jobs/path_runner.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

class JobLifecycle {
public:
    explicit JobLifecycle(const MachineConfig& machine) : path_(machine) {}

    const MachineActivity& activity() const { return activity_; }
    MachineActivity& activity() { return activity_; }
    const PathRunner& path() const { return path_; }
    PathRunner& path() { return path_; }
    /// The machine's jobs so far.
    const JobCount& count() const { return count_; }
    JobCount& count() { return count_; }

    /// Records the begin of a job. The caller enters its activity.
    MachineJob begin(JobKind kind, const Command& command, std::shared_ptr<const KnownProgram> program,
                     const AxisCounts& start, PublishingLoop& loop);
    /// The same for a job in the pause of another one.
    MachineJob begin_in_pause(JobKind kind, std::shared_ptr<const KnownProgram> program, const AxisCounts& start,
                              PublishingLoop& loop);
    /// Enters the next activity of a task. `pause`: the job to whose place the task returns.
    void follow(PathTask task, const PathNext& next, std::optional<activity::Paused> pause, CoordinatorLoop& loop);
    /// The job rests between two legs. If its program asks for an input, it waits for that from now on.
    void pause(activity::Paused paused, PublishingLoop& loop);
    /// Goes on to the next leg of a job that rests, after motors have made up the steps that they lost.
    void go_on(activity::Paused paused, CoordinatorLoop& loop);
    /// Ends the job in motion or held: done or stopped. A job in whose pause it took place waits again, or goes on.
    void end(JobOutcome outcome, CoordinatorLoop& loop);

    /// Fails the job, if there is one. A machine in motion first comes to rest: on the path, or each axis by itself.
    /// Further faults change nothing until a reset.
    void fail(const MachineFault& fault, CoordinatorLoop& loop);
    /// A fault that was found when the machine had come to rest.
    void fail_at_rest(const MachineFault& fault, PublishingLoop& loop);

    /// The inherited job, if there is one, ends where the axes rest.
    void cut_inherited(TakeoverDoubt doubt, PublishingLoop& loop);
    /// Another coordinator owns the machine now. The axes have come to rest without this one.
    void stand_down(PublishingLoop& loop);

private:
    void note_end(const MachineJob& job, JobOutcome outcome, PublishingLoop& loop);
    void finish(const MachineJob& job, JobOutcome outcome, PublishingLoop& loop);
    void end_in_pause(const MachineJob& job, activity::Paused pause, JobOutcome outcome, CoordinatorLoop& loop);
    void end_early(const MachineJob& job, std::optional<std::int32_t> line, FaultCode why, PublishingLoop& loop);

    MachineActivity activity_;
    JobCount count_;
    PathRunner path_;
};

/// Axes that move together come to rest on the path.
void brake_on_path(Intent intent, JobLifecycle& jobs, PublishingLoop& loop);
/// Axes that move by themselves come to rest.
void halt_axes(MachineActivity& activity, CoordinatorLoop& loop);

}  // namespace lockstep
