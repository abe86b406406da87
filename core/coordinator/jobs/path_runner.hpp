// Runs jobs with axes that move together on a path, leg by leg, in epochs of frames. Each leg is read as a stream. The
// rest of a leg after an interruption is run as a separate epoch.
#pragma once

#include <optional>
#include <vector>

#include "core/coordinator/jobs/path_task.hpp"
#include "core/coordinator/jobs/probing.hpp"
#include "core/coordinator/jobs/program_events.hpp"
#include "core/coordinator/jobs/takeover.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "core/coordinator/path/epoch_runner.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

class PathRunner {
public:
    explicit PathRunner(const MachineConfig& machine)
        : planner_(machine), runner_(machine), knows_places_(coordination_of(machine).tells_places) {}

    const ProgramPlanner& planner() const { return planner_; }
    ProgramEvents& events() { return events_; }

    /// Begins the next leg of the task in which something moves.
    PathNext begin_leg(PathTask& task, const LoopView& loop, std::vector<PublishedEvent>& out);
    /// Begins an epoch from this place of the leg in progress. `at`: where the axes rest there, exactly; empty: on
    /// whole steps, where they stand.
    void begin_epoch(PathTask& task, const PathPlace& place, MotorPositions at, const LoopView& loop);
    /// Continues the task of another coordinator. `events_from`: the events before this block were published.
    PathNext continue_rest(PathTask& task, const JobRest& rest, std::uint32_t events_from, const LoopView& loop,
                           std::vector<PublishedEvent>& out);
    /// The whole leg was run.
    PathNext end_leg(PathTask& task, const LoopView& loop, std::vector<PublishedEvent>& out);
    /// The same, but the next leg does not begin yet. Returns why the job pauses.
    Pause hold_behind_leg(PathTask& task) const;

    /// The end of a task that probes, behind a touch or at the end of its move; nullopt if it was interrupted before,
    /// or does not probe.
    std::optional<Probed> end_probe(const PathTask& task, const EpochEnd& end, const LoopView& loop) {
        return task.probe ? probing_.end(task, end, runner_, loop) : std::nullopt;
    }

    /// The result of the newest probing move.
    const std::optional<ProbeResult>& probe() const { return probing_.result(); }
    /// The newest epoch.
    Epoch epoch() const { return runner_.epoch(); }

    /// Call it in each slot of an epoch. Sends frames. Returns how the epoch ended, once it has.
    std::optional<EpochEnd> advance(const PathTask& task, const LoopView& loop, CoordinatorOutputs& out);
    /// The epoch should have come to rest long ago.
    bool is_overdue() const { return runner_.is_overdue(); }
    /// Brings the epoch in progress to rest by a veto in the state published in slot `next`.
    void stop(Slot next) { runner_.stop(next); }
    void end_epoch(PathTask& task, const EpochEnd& end, const LoopView& loop, std::vector<PublishedEvent>& out);
    /// The epoch ended early because no frame keeps the limits.
    bool is_stuck() const { return runner_.ending() == EpochRunner::Ending::Stuck; }
    /// The machine rests because no more of the program is known.
    bool waits_for_blocks() const {
        return runner_.ending() == EpochRunner::Ending::LacksProgram || runner_.source()->lacks_blocks();
    }

    const Overrides& overrides() const { return overrides_; }
    /// Sets the overrides. They apply from the next frame to be made, and to later jobs.
    void set_overrides(const Overrides& overrides) { overrides_ = overrides, runner_.set_overrides(overrides); }
    void inherit(const Overrides& overrides) { overrides_ = overrides; }

    void note_progress(PathTask& task, const LoopView& loop) const;
    /// Reports the epoch in progress, or the last one.
    void report_epoch(MachineState& state) const;
    /// Reports a task that moves.
    void report_moving(const PathTask& task, MachineState& state) const;
    /// Reports a task that is held at this place of a leg.
    void report_held(const PathTask& task, const PathPlace& place, MachineState& state) const;
    /// Reports a task that pauses between two legs.
    void report_paused(const PathTask& task, MachineState& state) const;
    /// How long the task takes after its pause.
    double seconds_after_pause(const PathTask& task) const;
    /// Reports where each frame would rest, for another coordinator that may continue the task.
    void report_rests(const PathTask& task, MachineState& state, const AxisRoster& axes) const;

private:
    std::optional<LegEnd> end_of_empty_leg(const PathTask& task) const;
    std::optional<Probed> end_probe_at_begin(const PathTask& task, const LoopView& loop);
    void pass_events(const PathTask& task, const LegEnd& end, const LoopView& loop, std::vector<PublishedEvent>& out);
    void load_leg(const PathTask& task);
    void note_start(const PathTask& task, const LoopView& loop, CoordinatorOutputs& out);
    ProgramEvents::Of of(const PathTask& task) const { return {task.job.number, task.has_moved ? runner_.epoch() : 0}; }
    void note_pulses(const LoopView& loop);
    Epoch next_epoch(const LoopView& loop);
    Subticks into_path(Tick now) const;
    double seconds_left(const PathPlace& place) const;

    ProgramPlanner planner_;
    EpochRunner runner_;
    bool knows_places_;  // a block is planned in one part, so that its place on the program tells where it was left
    Overrides overrides_;
    Epoch epoch_ = 0;  // the newest
    Probing probing_;
    ProgramEvents events_;
};

}  // namespace lockstep
