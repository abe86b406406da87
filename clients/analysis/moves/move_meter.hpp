// Measures the moves of each job, and traces the path of axes X and Y.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/analysis/measure/lateness.hpp"
#include "clients/analysis/measure/merged_steps.hpp"
#include "clients/analysis/measure/plane_trace.hpp"
#include "clients/analysis/motors/motor_skew.hpp"
#include "clients/analysis/moves/job_moves.hpp"
#include "clients/analysis/moves/job_turns.hpp"
#include "clients/analysis/moves/mapped_plane.hpp"
#include "core/machine.hpp"

namespace lockstep::analysis {

/// Gets the places of axes X and Y, in mm, at each tick at which one of them makes a step, in jobs with a program.
/// Between counts, a place is halfway.
using OnPlace = std::function<void(Tick tick, drawing::Point place_mm)>;

class MoveMeter {
public:
    /// How many jobs may be open. Messages of the next job may come before the last steps of the previous one.
    static constexpr std::size_t kJobsOpen = 16;

    /// What was measured of a job.
    struct Measured {
        std::vector<std::string> motors;  // of its machine, without the boards
        JobMoves moves;
        MotorSkewMeter skew;
    };
    /// Called when a job is over, with the number given to begin().
    using OnJob = std::function<void(std::size_t number, Measured&)>;
    /// `keeps_plane`: plane() is wanted.
    MoveMeter(OnJob on_job, bool keeps_plane) : on_job_(std::move(on_job)), keeps_plane_(keeps_plane) {}

    /// Only for machines with axes X and Y.
    void set_on_place(OnPlace on_place) { on_place_ = std::move(on_place); }
    /// Sets the name of a lane's motor.
    void name_lane(std::size_t lane, const std::string& motor);
    /// Begins a job. All steps from `from` on belong to it, until the next job begins, or one goes on.
    void begin(std::size_t number, Tick from, const MachineConfig& machine, JobMoves moves, bool is_homing = false);
    /// A job in the pause of this one has ended. All steps from `from` on belong to this one again.
    void go_on(std::size_t number, Tick from);
    /// The path of this job is planned again, behind a hold or an override.
    void plan_again(std::size_t number);
    /// Takes the next steps of all axes, in the order of their ticks.
    void take(MergedSteps steps);
    /// The path of axes X and Y, in steps. If the motors are not the axes, a step is Kinematics::step_mm. It contains
    /// the jobs in which axes move together, or all steps if there is no such job.
    const PlaneTrace& plane() const { return plane_; }
    void on_late(const std::string& motor, EquallyLate late);
    /// Steps made before the first job began.
    std::int64_t steps_of_no_job() const { return steps_of_no_job_; }
    /// Call once, at the end.
    void finish();

private:
    struct Job {
        std::size_t number = 0;
        Measured measured;
        std::vector<std::optional<MotorIndex>> motor_of_lane;
        bool is_direct = true;                 // its machine's motors are its axes; otherwise `plane` is used
        std::vector<std::int64_t> counts;      // of the motors, after the places that were passed on
        std::array<double, 2> steps_per_mm{};  // of X and Y
        std::optional<MappedPlane> plane;      // with a program in the plane
        bool is_traced = false;                // a step of it was traced

        std::optional<MotorIndex> motor(const std::string& name) const;
    };

    /// Null before the first job, and for a job that is over.
    Job* job_at(Tick tick);
    Job* job_of(std::size_t number);
    bool joins_plane(const MergedSteps& steps) const;
    void trace(Job* job, const MergedSteps& steps, Tick until);
    void begin_trace(Job& job);
    void pass_places(Job& job, const MergedSteps& steps, Tick until) const;
    void trace_lanes(const MergedSteps& steps, Tick until);
    void trace_by_map(Job& job, const MergedSteps& steps, Tick until);
    void pass_place(const Job& job, std::vector<Position>& at, MotorIndex motor, int direction, Tick tick) const;
    void end_first();

    OnJob on_job_;
    bool keeps_plane_;
    OnPlace on_place_;
    std::vector<std::string> lanes_;                    // the motor of each
    std::vector<std::optional<std::size_t>> in_plane_;  // axis of PlaneTrace, 0 or 1, of each lane
    std::vector<std::int64_t> traced_counts_;           // of a mapped plane, in whichever job
    std::vector<Job> jobs_;                             // in the order of their last turns
    JobTurns turns_;
    PlaneTrace plane_;
    bool plane_is_of_jobs_ = false;
    std::int64_t steps_of_no_job_ = 0;
};

}  // namespace lockstep::analysis
