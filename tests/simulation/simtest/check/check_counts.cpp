#include <numeric>

#include "tests/simulation/simtest/check/checks.hpp"

namespace lockstep::simtest {
namespace {

std::int64_t sum(const std::vector<std::int64_t>& ways) { return std::reduce(ways.begin(), ways.end()); }

void check_order(const Recording& recording, Violations& violations) {
    for (std::size_t i = 0; i < recording.motors.size(); ++i) {
        const auto& steps = recording.motors[i].steps;
        for (std::size_t n = 1; n < steps.size(); ++n) {
            if (steps[n].tick <= steps[n - 1].tick) {
                violations.push_back({"order", i, steps[n].tick.value, n, "not later than the previous step"});
                break;
            }
        }
    }
}

void check_sum(const Recording& recording, const JobRecord& job, std::size_t i, Violations& violations) {
    if (!job.is_whole()) { return; }
    const std::int64_t end = job.course.from[i] + sum(recording.slide_ways(job, i));
    if (end == job.course.to[i]) { return; }
    violations.push_back(
        {"exact",
         i,
         {},
         job.end_step[i],
         "its steps lead to " + std::to_string(end) + ", the program to " + std::to_string(job.course.to[i])});
}

}  // namespace

Violations check_counts(const Recording& recording) {
    Violations violations;
    check_order(recording, violations);
    for (std::size_t i = 0; i < recording.motors.size(); ++i) {
        std::size_t at = 0;
        for (const JobRecord& job : recording.jobs) {
            if (job.first_step[i] != at) {
                violations.push_back({"exact", i, {}, at, "steps outside any job"});
                break;
            }
            at = job.end_step[i];
            if (!job.homing) { check_sum(recording, job, i, violations); }
        }
        if (at != recording.motors[i].steps.size()) {
            violations.push_back({"exact", i, {}, at, "steps after the last job"});
        }
    }
    return violations;
}

Violations check_all(const Recording& recording) {
    Violations violations = check_counts(recording);
    const Followings followings = follow_all(recording);
    append(violations, check_limits(recording, followings));
    if (violations.empty()) { append(violations, check_together(recording, followings)); }
    append(violations, check_frames(recording));
    append(violations, check_stops(recording));
    append(violations, check_jogs(recording));
    append(violations, check_owners(recording));
    append(violations, check_probes(recording));
    if (violations.empty()) { append(violations, check_outputs(recording, followings)); }
    if (violations.empty()) { append(violations, check_pulses(recording, followings)); }
    return violations;
}

}  // namespace lockstep::simtest
