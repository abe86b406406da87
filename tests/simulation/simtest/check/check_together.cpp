#include <string>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/record/follow.hpp"

namespace lockstep::simtest {
namespace {

constexpr double kHair = 1e-6;

void check_job(const Recording& recording, const JobRecord& job, const std::vector<Tick>& until,
               Violations& violations) {
    const Following following = follow(recording, job, until);
    if (const auto& left = following.departure) {
        violations.push_back({"together", left->axis, left->tick.value, job.first_step[left->axis] + left->step,
                              "no place on the program fits this step: before it the machine was from " +
                                  std::to_string(left->before.first) + " to " + std::to_string(left->before.last) +
                                  " of " + std::to_string(job.course.stretches.size()) + " moves"});
    } else if (job.outcome == JobOutcome::Done && following.end.last < job.course.end() - kHair) {
        violations.push_back({"together",
                              {},
                              {},
                              {},
                              "done, but only " + std::to_string(following.end.last) + " of " +
                                  std::to_string(job.course.stretches.size()) + " moves were made"});
    }
}

}  // namespace

Violations check_together(const Recording& recording) {
    Violations violations;
    const auto epochs = epoch_runs(recording);
    for (const JobRecord& job : recording.jobs) {
        if (!job.homing) { check_job(recording, job, bound_until(recording, epochs, job), violations); }
    }
    return violations;
}

}  // namespace lockstep::simtest
