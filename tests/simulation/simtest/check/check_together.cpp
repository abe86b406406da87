#include <string>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/record/follow.hpp"

namespace lockstep::simtest {
namespace {

constexpr double kEndTolerance = 1e-6;

void check_job(const JobRecord& job, const Following& following, Violations& violations) {
    if (const auto& left = following.departure) {
        violations.push_back({"together", left->axis, left->tick.value, job.first_step[left->axis] + left->step,
                              "no place on the program fits this step: before it the machine was from " +
                                  std::to_string(left->before.first) + " to " + std::to_string(left->before.last) +
                                  " of " + std::to_string(job.course.stretches.size()) + " moves"});
    } else if (job.is_whole() && following.end.last < job.course.end() - kEndTolerance) {
        violations.push_back({"together",
                              {},
                              {},
                              {},
                              "done, but only " + std::to_string(following.end.last) + " of " +
                                  std::to_string(job.course.stretches.size()) + " moves were made"});
    }
}

}  // namespace

Violations check_together(const Recording& recording, const Followings& followings) {
    Violations violations;
    for (std::size_t k = 0; k < recording.jobs.size(); ++k) {
        if (followings[k]) { check_job(recording.jobs[k], *followings[k], violations); }
    }
    return violations;
}

}  // namespace lockstep::simtest
