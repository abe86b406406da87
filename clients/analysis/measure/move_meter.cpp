#include "clients/analysis/measure/move_meter.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace lockstep::analysis {

std::optional<std::size_t> MoveMeter::Job::axis(const std::string& name) const {
    const auto found = std::ranges::find(axes, name);
    if (found == axes.end() || moves.asked().axes() == 0) { return std::nullopt; }
    return static_cast<std::size_t>(found - axes.begin());
}

void MoveMeter::name_lane(std::size_t lane, const std::string& axis) {
    if (lanes_.size() <= lane) {
        lanes_.resize(lane + 1);
        in_plane_.resize(lane + 1);
    }
    lanes_[lane] = axis;
    if (axis == "X") { in_plane_[lane] = 0; }
    if (axis == "Y") { in_plane_[lane] = 1; }
    for (Job& job : jobs_) {
        job.axis_of_lane.resize(lanes_.size());
        job.axis_of_lane[lane] = job.axis(axis);
    }
}

void MoveMeter::begin(std::size_t number, Tick from, const MachineConfig& machine, JobMoves moves) {
    if (jobs_.size() == kJobsOpen) { end_first(); }
    begin_turn({from, number});
    Job job{.number = number, .axes = machine.axis_names(), .moves = std::move(moves), .axis_of_lane = {}};
    for (const std::string& lane : lanes_) { job.axis_of_lane.push_back(job.axis(lane)); }
    jobs_.push_back(std::move(job));
}

void MoveMeter::go_on(std::size_t number, Tick from) {
    const auto job = std::ranges::find(jobs_, number, &Job::number);
    if (job == jobs_.end()) { return; }
    std::rotate(job, job + 1, jobs_.end());
    begin_turn({from, number});
}

void MoveMeter::begin_turn(const Turn& turn) {
    if (turns_.size() == kTurnsKept) { turns_.erase(turns_.begin()); }
    turns_.push_back(turn);
}

MoveMeter::Job* MoveMeter::job_of(std::size_t number) {
    const auto job = std::ranges::find(jobs_, number, &Job::number);
    return job == jobs_.end() ? nullptr : &*job;
}

MoveMeter::Job* MoveMeter::job_at(Tick tick) {
    auto turn = turns_.rbegin();
    while (turn != turns_.rend() && turn->from > tick) { ++turn; }
    return turn == turns_.rend() ? nullptr : job_of(turn->number);
}

void MoveMeter::plan_again(std::size_t number) {
    for (Job& job : jobs_) {
        if (job.number == number) { job.moves.plan_again(); }
    }
}

Tick MoveMeter::end_of_turn(Tick tick) const {
    Tick end{std::numeric_limits<std::int64_t>::max()};
    for (const Turn& turn : turns_) {
        if (turn.from > tick) { end = std::min(end, turn.from); }
    }
    return end;
}

void MoveMeter::take(MergedSteps steps) {
    while (!steps.empty()) {
        Job* job = job_at(steps.tick());
        const Tick until = end_of_turn(steps.tick());
        if (keeps_plane_) { trace(job, steps, until); }
        if (job != nullptr) {
            job->moves.take(steps, job->axis_of_lane, until);
        } else {
            steps_of_no_job_ += std::ssize(steps.before(until));
            steps.pass_before(until);
        }
    }
}

void MoveMeter::trace(const Job* job, const MergedSteps& steps, Tick until) {
    const bool of_a_job = job != nullptr && job->moves.is_on_a_line();
    if (of_a_job && !std::exchange(plane_is_of_jobs_, true)) { plane_ = {}; }
    if (of_a_job != plane_is_of_jobs_) { return; }
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

/// Whether the plane's axes are where these steps begin.
bool MoveMeter::joins_plane(const MergedSteps& steps) const {
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
        const MergedSteps::Lane& lane = steps.lanes()[i];
        if (in_plane_[i] && !lane.steps.empty() && !plane_.is_at(*in_plane_[i], lane.count)) { return false; }
    }
    return true;
}

void MoveMeter::on_late(const std::string& axis, EquallyLate late) {
    while (true) {
        const std::size_t all = late.steps.size();
        Job* job = job_at(late.commanded(0));
        std::size_t count = job_at(late.commanded(all - 1)) == job ? all : 1;
        while (count < all && job_at(late.commanded(count)) == job) { ++count; }
        const auto number = job != nullptr ? job->axis(axis) : std::nullopt;
        if (number) { job->moves.take(*number, late.first(count)); }
        if (count == all) { return; }
        late = late.behind(count);
    }
}

void MoveMeter::end_first() {
    Job& job = jobs_.front();
    on_job_(job.number, job.axes, job.moves);
    jobs_.erase(jobs_.begin());
}

void MoveMeter::finish() {
    while (!jobs_.empty()) { end_first(); }
}

}  // namespace lockstep::analysis
