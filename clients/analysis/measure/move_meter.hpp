// Finds the job that each step belongs to, and measures the job's moves.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clients/analysis/measure/job_moves.hpp"
#include "clients/analysis/measure/lateness.hpp"
#include "clients/analysis/measure/merged_steps.hpp"
#include "clients/analysis/measure/plane_trace.hpp"
#include "core/machine.hpp"

namespace lockstep::analysis {

class MoveMeter {
public:
    /// How many jobs may be open. Messages of the next job may come before the last steps of the previous one.
    static constexpr std::size_t kJobsOpen = 16;

    /// Called when a job is over, with the number given to begin(), the axes of its machine, and its moves.
    using OnJob = std::function<void(std::size_t number, const std::vector<std::string>& axes, JobMoves&)>;
    /// `keeps_plane`: plane() is wanted.
    MoveMeter(OnJob on_job, bool keeps_plane) : on_job_(std::move(on_job)), keeps_plane_(keeps_plane) {}

    /// Sets the name of a lane's axis.
    void name_lane(std::size_t lane, const std::string& axis);
    /// Begins a job. All steps from `from` on belong to it, until the next job begins, or one goes on.
    void begin(std::size_t number, Tick from, const MachineConfig& machine, JobMoves moves);
    /// A job in the pause of this one has ended. All steps from `from` on belong to this one again.
    void go_on(std::size_t number, Tick from);
    /// The path of this job is planned again, behind a hold or an override.
    void plan_again(std::size_t number);
    /// Takes the next steps of all axes, in the order of their ticks.
    void take(MergedSteps steps);
    /// The path of axes X and Y, in steps. It contains the jobs in which axes move together, or all steps if there is
    /// no such job.
    const PlaneTrace& plane() const { return plane_; }
    void on_late(const std::string& axis, EquallyLate late);
    /// Steps made before the first job began.
    std::int64_t steps_of_no_job() const { return steps_of_no_job_; }
    /// Call once, at the end.
    void finish();

private:
    struct Job {
        std::size_t number = 0;
        std::vector<std::string> axes;
        JobMoves moves;
        std::vector<std::optional<std::size_t>> axis_of_lane;

        std::optional<std::size_t> axis(const std::string& name) const;
    };

    /// From here on steps belong to the job.
    struct Turn {
        Tick from;
        std::size_t number = 0;
    };
    /// Null before the first job, and for a job that is over.
    Job* job_at(Tick tick);
    /// When the next turn begins after a tick.
    Tick end_of_turn(Tick tick) const;
    Job* job_of(std::size_t number);
    void begin_turn(const Turn& turn);
    bool joins_plane(const MergedSteps& steps) const;
    void trace(const Job* job, const MergedSteps& steps, Tick until);
    void end_first();

    OnJob on_job_;
    bool keeps_plane_;
    std::vector<std::string> lanes_;                    // the axis of each
    std::vector<std::optional<std::size_t>> in_plane_;  // axis of PlaneTrace, 0 or 1, of each lane
    static constexpr std::size_t kTurnsKept = 4 * kJobsOpen;
    std::vector<Job> jobs_;    // in the order of their last turns
    std::vector<Turn> turns_;  // the newest, in the order of time
    PlaneTrace plane_;
    bool plane_is_of_jobs_ = false;
    std::int64_t steps_of_no_job_ = 0;
};

}  // namespace lockstep::analysis
