// The job of the machine: begun for a client, inherited at a takeover, interrupted, resumed and ended.
#pragma once

#include <optional>

#include "core/coordinator/jobs/homing_sequence.hpp"
#include "core/coordinator/jobs/inherited_job.hpp"
#include "core/coordinator/jobs/job.hpp"
#include "core/coordinator/jobs/jogs.hpp"
#include "core/coordinator/jobs/own_targets.hpp"
#include "core/coordinator/jobs/path_job.hpp"
#include "core/coordinator/state/refusal.hpp"

namespace lockstep {

class JobRunner {
public:
    JobRunner(const MachineConfig& machine, std::uint64_t config_hash, BeginSteps begin_steps,
              std::optional<OnTakeover> on_takeover)
        : begin_steps_(begin_steps), path_(machine), jogs_(machine), inherited_(on_takeover, config_hash) {}

    // Commands of clients.
    CommandResult home(const Command& command, CoordinatorLoop& loop);
    CommandResult run(const Command& command, CoordinatorLoop& loop);
    CommandResult move_own(const Command& command, CoordinatorLoop& loop);
    CommandResult jog(const Command& command, CoordinatorLoop& loop);
    /// Takes a repeated command. Returns false if its jog is over.
    bool renew_jog(const Command& command, const CoordinatorLoop& loop) { return jogs_.renew(command, loop); }
    CommandResult interrupt(Intent intent, CoordinatorLoop& loop);
    /// Axes that were jogged in the pause first return to its place, if the command says so.
    CommandResult resume(const Command& command, CoordinatorLoop& loop);
    /// May be called at any time. Overrides hold until they are changed again.
    CommandResult turn(const Command& command, const CoordinatorLoop& loop);

    /// Call it in each loop.
    void advance_jogs(CoordinatorLoop& loop);
    /// Call it in each slot.
    void advance(CoordinatorLoop& loop);
    /// Call it when every axis follows this coordinator and rests. Continues an inherited job.
    void go_on_with_inherited(CoordinatorLoop& loop);

    /// The client with the lease fell silent. Its job on a path runs on or is held, as configured.
    void lose_client(Identity client, CoordinatorLoop& loop);
    /// The client has given the lease back: its job runs on without it.
    void leave_to_itself(Identity client) {
        if (client_ == client) { client_.reset(); }
    }

    /// A fault during motion first stops the motion on the path. Fault is entered at rest.
    void fail(FaultCode fault, std::size_t axis, CoordinatorLoop& loop);
    /// A person gives up the job, held or inherited.
    void drop(CoordinatorLoop& loop);
    /// An axis of an inherited job cannot be trusted.
    void doubt_inherited(CoordinatorLoop& loop) { cut_inherited(TakeoverDoubt::AxisInDoubt, loop); }

    /// This coordinator owns the machine now. `last`: the newest state of the last owner.
    void take_over(const std::optional<MachineState>& last, CoordinatorLoop& loop);
    /// Another coordinator owns the machine now. The axes have come to rest without this one.
    void stand_down();
    void note_interrupt(Slot now) { inherited_.note_interrupt(now); }

    bool exists() const { return job_.has_value(); }
    /// A job waits for a person, and nothing moves.
    static bool is_paused(const CoordinatorLoop& loop) { return loop.condition.phase() == MachinePhase::Paused; }
    /// Also true for a job that this coordinator has taken over and not continued yet.
    bool has_any() const { return exists() || inherited_.exists(); }
    /// An epoch of frames is in progress.
    bool is_on_path() const { return path_.is_moving(); }
    bool is_jogging() const { return has_jog() && intent_ == Intent::GoOn; }
    bool in_motion() const { return is_on_path() || axes_move_alone(); }
    std::uint64_t number() const { return count_.number(); }
    void note_progress(const CoordinatorLoop& loop) {
        if (path_.is_moving()) { path_.note_progress(loop); }
    }
    void report(MachineState& state, const CoordinatorLoop& loop) const;

private:
    /// The job in progress takes place in the pause of another.
    bool is_in_pause() const { return paused_.has_value(); }
    bool returns() const { return job_ && job_->kind == JobKind::Return; }
    bool has_jog() const { return job_ && job_->kind == JobKind::Jog; }
    bool axes_move_alone() const { return job_ && job_->is_alone(); }
    void begin(JobKind kind, const Command& command, const AxisCounts& start_counts, CoordinatorLoop& loop);
    void begin_in_pause(JobKind kind, std::shared_ptr<const KnownProgram> program, const AxisCounts& start_counts,
                        CoordinatorLoop& loop);
    CommandResult check_jog(const CoordinatorLoop& loop) const;
    CommandResult check_place(const CoordinatorLoop& loop) const;
    CommandResult begin_return(CoordinatorLoop& loop);
    void end_in_pause(JobOutcome outcome, CoordinatorLoop& loop);
    void home_next_group(CoordinatorLoop& loop);
    void advance_path(CoordinatorLoop& loop);
    void advance_homing(CoordinatorLoop& loop);
    void advance_alone(CoordinatorLoop& loop);
    CommandResult interrupt_alone(Intent intent, CoordinatorLoop& loop);
    void halt_alone(CoordinatorLoop& loop);
    void settle(const EpochEnd& end, CoordinatorLoop& loop);
    void interrupted(const EpochEnd& end, CoordinatorLoop& loop);
    void give_up_epoch(CoordinatorLoop& loop);
    void follow(PathJob::Next next, CoordinatorLoop& loop);
    void end(JobOutcome outcome, CoordinatorLoop& loop);
    void end_program(CoordinatorLoop& loop);
    void end_failed(CoordinatorLoop& loop);
    void report_pause(MachineState& state, const CoordinatorLoop& loop) const;
    void cut_inherited(TakeoverDoubt doubt, CoordinatorLoop& loop);

    BeginSteps begin_steps_;
    JobCount count_;
    std::optional<MachineJob> job_;
    std::optional<MachineJob> paused_;  // the job in whose pause job_ takes place
    std::optional<Identity> client_;    // that attends to the job: began it, or resumed it after its loss
    Intent intent_ = Intent::GoOn;
    PathJob path_;
    HomingSequence homing_;
    OwnTargets own_;
    Jogs jogs_;
    InheritedJob inherited_;
};

}  // namespace lockstep
