#include "tests/simulation/simtest/check/checks.hpp"

namespace lockstep::simtest {
namespace {

std::int64_t sum(std::span<const StepEdge> steps) {
    std::int64_t count = 0;
    for (const StepEdge& step : steps) { count += step.direction; }
    return count;
}

void check_order(const Recording& recording, Violations& violations) {
    for (std::size_t i = 0; i < recording.axes.size(); ++i) {
        const auto& steps = recording.axes[i].steps;
        for (std::size_t n = 1; n < steps.size(); ++n) {
            if (steps[n].tick <= steps[n - 1].tick) {
                violations.push_back({"order", i, steps[n].tick.value, n, "not later than the previous step"});
                break;
            }
        }
    }
}

void check_sequence(const Recording& recording, const JobRecord& job, std::size_t i, Violations& violations) {
    const AxisCourse& course = job.course.axes[i];
    const std::span<const StepEdge> steps = recording.steps_of(job, i);
    for (std::size_t n = 0; n < steps.size(); ++n) {
        const bool more = n < course.move_of_step.size();
        if (more && steps[n].direction == course.direction[course.move_of_step[n]]) { continue; }
        violations.push_back({"exact", i, steps[n].tick.value, job.first_step[i] + n,
                              more ? "a step against the direction of the program"
                                   : "a step beyond the program's " + std::to_string(course.steps())});
        return;
    }
    if (job.outcome != JobOutcome::Done) { return; }
    if (static_cast<std::int64_t>(steps.size()) != course.steps() ||
        job.course.from[i] + sum(steps) != job.course.to[i]) {
        violations.push_back({"exact",
                              i,
                              {},
                              job.end_step[i],
                              std::to_string(steps.size()) + " steps made of " + std::to_string(course.steps())});
    }
}

}  // namespace

Violations check_counts(const Recording& recording) {
    Violations violations;
    check_order(recording, violations);
    for (std::size_t i = 0; i < recording.axes.size(); ++i) {
        std::size_t at = 0;
        for (const JobRecord& job : recording.jobs) {
            if (job.first_step[i] != at) {
                violations.push_back({"exact", i, {}, at, "steps outside any job"});
                break;
            }
            at = job.end_step[i];
            if (!job.homing) { check_sequence(recording, job, i, violations); }
        }
        if (at != recording.axes[i].steps.size()) {
            violations.push_back({"exact", i, {}, at, "steps after the last job"});
        }
    }
    return violations;
}

Violations check_all(const Recording& recording) {
    Violations violations = check_counts(recording);
    append(violations, check_limits(recording));
    if (violations.empty()) { append(violations, check_together(recording)); }
    append(violations, check_frames(recording));
    append(violations, check_stops(recording));
    append(violations, check_owners(recording));
    return violations;
}

}  // namespace lockstep::simtest
