// A job with axes that move together on a path, leg by leg, in epochs of frames. Each leg is read as a stream. The rest
// of a leg after an interruption is run as a separate epoch.
#pragma once

#include <optional>

#include "core/coordinator/jobs/job.hpp"
#include "core/coordinator/jobs/path_progress.hpp"
#include "core/coordinator/jobs/program_events.hpp"
#include "core/coordinator/jobs/takeover.hpp"
#include "core/coordinator/path/epoch_runner.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

class PathJob {
public:
    explicit PathJob(const MachineConfig& machine)
        : planner_(machine), runner_(machine), knows_places_(machine.coordination != StepMethod::Lai) {}

    const ProgramPlanner& planner() const { return planner_; }
    /// An epoch is in progress.
    bool is_moving() const { return is_moving_; }
    const Overrides& overrides() const { return overrides_; }
    ProgramEvents& events() { return events_; }
    const ProgramEvents& events() const { return events_; }

    /// The next activity of the job after a leg has begun or ended.
    enum class Next : std::uint8_t { Moves, Pauses, IsDone };

    /// Replaces the last job.
    void load(const MachineJob& job, const AxisCounts& start);
    /// Call it in a pause: a return replaces the job until take_up().
    void load_return(const MachineJob& back, const AxisCounts& start);
    /// The job that paused is loaded again, as it was in its pause.
    void take_up();
    /// `events_from`: the events before this block have been published.
    void load(const MachineJob& job, const JobRest& rest, double progress, std::uint32_t events_from);
    Next begin_leg(CoordinatorLoop& loop);
    /// Runs the rest of the leg in progress. Begins the next leg if nothing is left.
    Next go_on(CoordinatorLoop& loop);
    Next end_leg(CoordinatorLoop& loop);
    /// The leg has ended, and the next one must not begin yet.
    void hold_behind_leg() {
        if (!pass_leg(runner_.source()->end())) { pause_ = {.reason = PauseReason::Hold}; }
    }
    /// Why the job pauses, and where it goes on. Only meaningful in a pause.
    const Pause& pause() const { return pause_; }
    const AxisCounts& place() const { return aside_ ? aside_->from : from_; }

    /// Call it in each slot of an epoch. Sends frames. Returns how the epoch ended, once it has.
    std::optional<EpochEnd> advance(CoordinatorLoop& loop);
    /// The epoch should have come to rest long ago.
    bool is_overdue() const { return runner_.is_overdue(); }
    /// Brings the epoch in progress to rest by a veto in the state published in slot `next`.
    void stop(Slot next) { runner_.stop(next); }
    void end_epoch(const EpochEnd& end, CoordinatorLoop& loop);
    void give_up_epoch() { is_moving_ = false; }
    /// Call it when all axes rest together on the path, as their counts prove.
    void interrupt(const EpochEnd& end);
    /// Call it after an interruption that nobody asked for. Returns false if too many of them in a row left no frame
    /// that was run.
    bool may_try_again(const EpochEnd& end);
    /// The epoch ended early because no frame keeps the limits.
    bool is_stuck() const { return runner_.ending() == EpochRunner::Ending::Stuck; }
    /// The machine rests because no more of the program is known.
    bool waits_for_blocks() const {
        return runner_.ending() == EpochRunner::Ending::LacksProgram || runner_.source()->lacks_blocks();
    }

    /// Sets the overrides. They apply from the next frame to be made, and to later jobs.
    void turn(const Overrides& overrides);
    void inherit(const Overrides& overrides) { overrides_ = overrides; }

    void note_progress(const CoordinatorLoop& loop);
    /// Reports the epoch in progress, or the last one.
    void report_epoch(MachineState& state) const;
    void report_progress(MachineState& state) const;
    /// Reports the place where the job rests: held on the path, or paused behind a leg.
    void report_held(MachineState& state) const;
    void report_paused(MachineState& state) const;
    /// Reports where each frame would rest, for another coordinator that may continue the job.
    void report_rests(MachineState& state, const AxisRoster& axes) const;
    /// The line of the program at which the job is.
    std::optional<std::int32_t> line(Tick now) const { return runner_.source()->line_of(runner_.place_at(now).block); }

private:
    void begin(const MachineJob& job, const AxisCounts& start);
    bool pass_leg(const LegEnd& end);
    void pass_events(const LegEnd& end, CoordinatorLoop& loop);
    ProgramEvents::Of of() const { return {job_.number, has_moved_ ? runner_.epoch() : 0}; }
    std::optional<LegEnd> end_of_empty_leg() const;
    void load_leg();
    void begin_epoch(AxisPositions at, CoordinatorLoop& loop);
    void note_start(CoordinatorLoop& loop);
    Epoch next_epoch(const CoordinatorLoop& loop);
    Subticks into_path(Tick now) const;
    double seconds_left(const PathPlace& place) const;

    static constexpr int kMaxFruitless = 3;

    ProgramPlanner planner_;
    EpochRunner runner_;
    bool knows_places_;  // a block is planned in one part, so that its place on the program tells where it was left
    Overrides overrides_;
    Epoch epoch_ = 0;  // the newest
    bool is_moving_ = false;
    bool has_started_ = false;  // the epoch has started with its first frame
    Overrides planned_;         // the overrides with which the epoch begins

    ProgramEvents events_;

    // Of the job:
    MachineJob job_;
    bool has_moved_ = false;  // an epoch was begun
    std::uint32_t next_ = 0;  // the first block of the next leg, or of the one in progress
    AxisCounts from_;         // where that leg begins
    PathProgress progress_;
    Pause pause_;                     // after the last leg
    PathPlace resume_;                // where the epoch begins; held or interrupted: where the next one begins
    AxisPositions positions_;         // where the axes rest there, exactly; empty: on whole steps
    std::optional<LegEnd> leg_done_;  // the leg's end, if the last owner reached it
    int fruitless_ = 0;               // interruptions in a row without a frame that was run

    /// Of a job in its pause, while another is loaded.
    struct Aside {
        MachineJob job;
        bool has_moved = false;
        std::uint32_t next = 0;
        AxisCounts from;
        PathProgress progress;
    };
    std::optional<Aside> aside_;
};

}  // namespace lockstep
