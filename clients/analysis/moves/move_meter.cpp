#include "clients/analysis/moves/move_meter.hpp"

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep::analysis {

std::optional<MotorIndex> MoveMeter::Job::motor(const std::string& name) const {
    const auto found = std::ranges::find(measured.motors, name);
    if (found == measured.motors.end()) { return std::nullopt; }
    return MotorIndex{static_cast<std::size_t>(found - measured.motors.begin())};
}

void MoveMeter::name_lane(std::size_t lane, const std::string& motor) {
    if (lanes_.size() <= lane) {
        lanes_.resize(lane + 1);
        in_plane_.resize(lane + 1);
    }
    lanes_[lane] = motor;
    if (motor == "X") { in_plane_[lane] = 0; }
    if (motor == "Y") { in_plane_[lane] = 1; }
    for (Job& job : jobs_) {
        job.motor_of_lane.resize(lanes_.size());
        job.motor_of_lane[lane] = job.motor(motor);
    }
}

void MoveMeter::begin(std::size_t number, Tick from, const MachineConfig& machine, JobMoves moves, bool is_homing) {
    if (jobs_.size() == kJobsOpen) { end_first(); }
    turns_.begin(number, from);
    auto plane = mapped_plane(machine, moves);
    const Kinematics kinematics(machine);
    MotorSkewMeter skew(kinematics, is_homing, moves.asked().starts().steps);
    Job job{.number = number,
            .measured = {moving_motor_names(machine), std::move(moves), std::move(skew)},
            .motor_of_lane = {},
            .is_direct = kinematics.is_direct(),
            .plane = std::move(plane)};
    const auto& starts = job.measured.moves.asked().starts().steps;
    job.counts.assign(starts.begin(), starts.end());
    for (const AxisConfig& axis : machine.axes) {
        if (axis.name == "X") { job.steps_per_mm[0] = axis.steps_per_mm; }
        if (axis.name == "Y") { job.steps_per_mm[1] = axis.steps_per_mm; }
    }
    for (const std::string& lane : lanes_) { job.motor_of_lane.push_back(job.motor(lane)); }
    jobs_.push_back(std::move(job));
}

void MoveMeter::go_on(std::size_t number, Tick from) {
    const auto job = std::ranges::find(jobs_, number, &Job::number);
    if (job == jobs_.end()) { return; }
    std::rotate(job, job + 1, jobs_.end());
    turns_.begin(number, from);
}

MoveMeter::Job* MoveMeter::job_of(std::size_t number) {
    const auto job = std::ranges::find(jobs_, number, &Job::number);
    return job == jobs_.end() ? nullptr : &*job;
}

MoveMeter::Job* MoveMeter::job_at(Tick tick) {
    const auto number = turns_.job_at(tick);
    return number ? job_of(*number) : nullptr;
}

void MoveMeter::plan_again(std::size_t number) {
    for (Job& job : jobs_) {
        if (job.number == number) { job.measured.moves.plan_again(); }
    }
}

void MoveMeter::take(MergedSteps steps) {
    while (!steps.empty()) {
        Job* job = job_at(steps.tick());
        const Tick until = turns_.next_after(steps.tick());
        if (keeps_plane_ || on_place_) { trace(job, steps, until); }
        if (job != nullptr) {
            job->measured.skew.take(steps, job->motor_of_lane, until);
            job->measured.moves.take(steps, job->motor_of_lane, until);
        } else {
            steps_of_no_job_ += std::ssize(steps.before(until));
            steps.pass_before(until);
        }
    }
}

void MoveMeter::trace(Job* job, const MergedSteps& steps, Tick until) {
    const bool of_a_job = job != nullptr && job->measured.moves.is_on_a_line();
    if (of_a_job && !std::exchange(plane_is_of_jobs_, true)) { plane_ = {}; }
    if (of_a_job != plane_is_of_jobs_) { return; }
    if (of_a_job && keeps_plane_ && job->is_direct) { begin_trace(*job); }
    if (of_a_job && on_place_ && job->is_direct) { pass_places(*job, steps, until); }
    const bool is_by_map = job != nullptr && !job->is_direct;
    if (!is_by_map && keeps_plane_) { trace_lanes(steps, until); }
    if (is_by_map && job->plane) { trace_by_map(*job, steps, until); }
}

/// Before an axis's first step in the job, it is where the program begins.
void MoveMeter::begin_trace(Job& job) {
    const auto x = job.motor("X");
    const auto y = job.motor("Y");
    if (!x || !y || std::exchange(job.is_traced, true)) { return; }
    plane_.begin_at(job.counts[*x], job.counts[*y]);
}

/// Before a motor's first step in the job, it is where the program begins.
void MoveMeter::pass_places(Job& job, const MergedSteps& steps, Tick until) const {
    const auto x = job.motor("X");
    const auto y = job.motor("Y");
    if (!x || !y) { return; }
    for (std::size_t i = 0; i < steps.lanes().size(); ++i) {
        const MergedSteps::Lane& lane = steps.lanes()[i];
        if (job.motor_of_lane[i] && !lane.steps.empty()) { job.counts[*job.motor_of_lane[i]] = lane.count; }
    }
    for (const MergedStep& step : steps.before(until)) {
        const auto& motor = job.motor_of_lane[step.lane()];
        if (!motor) { continue; }
        job.counts[*motor] += step.direction();
        const double half = 0.5 * step.direction();
        on_place_(steps.tick_of(step),
                  {(static_cast<double>(job.counts[*x]) - (motor == x ? half : 0)) / job.steps_per_mm[0],
                   (static_cast<double>(job.counts[*y]) - (motor == y ? half : 0)) / job.steps_per_mm[1]});
    }
}

/// Of a machine whose motors X and Y are its axes.
void MoveMeter::trace_lanes(const MergedSteps& steps, Tick until) {
    const auto merged = steps.before(until);
    if (joins_plane(steps)) { return plane_.steps(merged, in_plane_); }
    std::vector<std::int64_t> counts;
    for (const MergedSteps::Lane& lane : steps.lanes()) { counts.push_back(lane.count); }
    for (const MergedStep& step : merged) {
        const std::size_t lane = step.lane();
        counts[lane] += step.direction();
        if (in_plane_[lane]) { plane_.step(*in_plane_[lane], counts[lane], step.direction()); }
    }
}

/// Of a machine whose motors are not its axes. Before a motor's first step in the job, it is where the program begins.
void MoveMeter::trace_by_map(Job& job, const MergedSteps& steps, Tick until) {
    auto& [kinematics, x, y, x_scale, y_scale, counts] = *job.plane;
    for (std::size_t i = 0; i < steps.lanes().size(); ++i) {
        const MergedSteps::Lane& lane = steps.lanes()[i];
        if (job.motor_of_lane[i] && !lane.steps.empty()) { counts[*job.motor_of_lane[i]] = lane.count; }
    }
    if (counts != traced_counts_) { plane_.part(); }
    const bool passes_places = on_place_ && job.measured.moves.is_on_a_line();
    std::vector<Position> at;
    for (const std::int64_t count : counts) { at.push_back(Position::steps(count)); }
    const auto merged = steps.before(until);
    for (std::size_t i = 0; i < merged.size(); ++i) {
        const auto& motor = job.motor_of_lane[merged[i].lane()];
        if (motor) { at[*motor] = Position::steps(counts[*motor] += merged[i].direction()); }
        if (motor && passes_places) { pass_place(job, at, *motor, merged[i].direction(), steps.tick_of(merged[i])); }
        if (!keeps_plane_) { continue; }
        if (i + 1 < merged.size() && merged[i + 1].tick() == merged[i].tick()) { continue; }
        plane_.go_to({kinematics->axis_steps(x, at) * x_scale, kinematics->axis_steps(y, at) * y_scale});
    }
    traced_counts_ = counts;
}

/// At its step a motor is halfway between two counts. `at`: the places of the motors after the step.
void MoveMeter::pass_place(const Job& job, std::vector<Position>& at, MotorIndex motor, int direction,
                           Tick tick) const {
    const MappedPlane& plane = *job.plane;
    const Position after = at[motor];
    at[motor] = after - Displacement{direction * kHalfStep};
    on_place_(tick, {plane.kinematics->axis_steps(plane.x, at) / job.steps_per_mm[0],
                     plane.kinematics->axis_steps(plane.y, at) / job.steps_per_mm[1]});
    at[motor] = after;
}

/// Whether the plane's axes are where these steps begin.
bool MoveMeter::joins_plane(const MergedSteps& steps) const {
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
        const MergedSteps::Lane& lane = steps.lanes()[i];
        if (in_plane_[i] && !lane.steps.empty() && !plane_.is_at(*in_plane_[i], lane.count)) { return false; }
    }
    return true;
}

void MoveMeter::on_late(const std::string& motor, EquallyLate late) {
    while (true) {
        const std::size_t all = late.steps.size();
        Job* job = job_at(late.commanded(0));
        std::size_t count = job_at(late.commanded(all - 1)) == job ? all : 1;
        while (count < all && job_at(late.commanded(count)) == job) { ++count; }
        const auto number = job != nullptr ? job->motor(motor) : std::nullopt;
        if (number) { job->measured.moves.take(*number, late.first(count)); }
        if (count == all) { return; }
        late = late.behind(count);
    }
}

void MoveMeter::end_first() {
    Job& job = jobs_.front();
    on_job_(job.number, job.measured);
    jobs_.erase(jobs_.begin());
}

void MoveMeter::finish() {
    while (!jobs_.empty()) { end_first(); }
}

}  // namespace lockstep::analysis
