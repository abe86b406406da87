// Runs jobs with axes that move together on a path, leg by leg, in epochs of frames. Each leg is read as a stream. The
// rest of a leg after an interruption is run as a separate epoch.
#pragma once

#include <optional>
#include <vector>

#include "core/coordinator/epoch/epoch_runner.hpp"
#include "core/coordinator/jobs/path_task.hpp"
#include "core/coordinator/jobs/probing.hpp"
#include "core/coordinator/jobs/program_events.hpp"
#include "core/coordinator/jobs/takeover.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

class PathRunner {
public:
    explicit PathRunner(const MachineConfig& machine) : planner_(machine), runner_(machine) {}

    const ProgramPlanner& planner() const { return planner_; }
    const ProgramEvents& events() const { return events_; }
    ProgramEvents& events() { return events_; }
    /// The epoch in progress, or the newest one.
    const EpochRunner& runner() const { return runner_; }
    EpochRunner& runner() { return runner_; }

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

    const Probing& probing() const { return probing_; }
    /// Call it in each slot of an epoch. Sends frames. Returns how the epoch ended, once it has.
    std::optional<EpochEnd> advance(const PathTask& task, const LoopView& loop, CoordinatorOutputs& out);
    void end_epoch(PathTask& task, const EpochEnd& end, const LoopView& loop, std::vector<PublishedEvent>& out);

    const Overrides& overrides() const { return overrides_; }
    /// Sets the overrides. They apply from the next frame to be made, and to later jobs.
    void set_overrides(const Overrides& overrides) { overrides_ = overrides, runner_.overrides().set(overrides); }
    /// How long the program takes from this place of the leg in progress on. Considers the feed override, but not that
    /// the axes' limits may allow less than the feed.
    double seconds_left(const PathPlace& place) const {
        return runner_.source()->seconds_from(place) / overrides_.feed();
    }

private:
    std::optional<Probed> end_probe_at_begin(const PathTask& task, const LoopView& loop);
    void pass_events(const PathTask& task, const LegEnd& end, const LoopView& loop, std::vector<PublishedEvent>& out);
    void note_start(const PathTask& task, const LoopView& loop, CoordinatorOutputs& out);

    ProgramPlanner planner_;
    EpochRunner runner_;
    Overrides overrides_;
    Probing probing_;
    ProgramEvents events_;
};

}  // namespace lockstep
