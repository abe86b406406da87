// Steps that a process left without the record of their run, since it ended: against all that its device may have run.
//
// Which frames were armed when it ended, the log does not say. So each course that the plan allows is made again, step
// by step, and the steps decide: the frames to come one after the other, and after any of them its tail.
//
// The process that came next finds steps in the device that nobody had taken yet, and says them as its own, counted by
// the device. What the one before had taken and not said is missing between.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/analysis/log/run.hpp"
#include "clients/verification/seen_step.hpp"

namespace lockstep::verification {

/// Runs one after the other that end at rest, or at the end of what is planned.
using Course = std::vector<analysis::Run>;

/// The process whose runs the courses follow.
struct LeftBy {
    std::int64_t incarnation = 0;
    std::optional<std::int64_t> zero_count;  // machine coordinates = device count - zero_count; none: not known
};

/// The first step that does not fit, beside the one that the course has there.
struct Misfit {
    const analysis::Run* run = nullptr;  // which it should be of; of the courses given
    std::optional<StepEdge> expected;    // none: the course is over
    std::int64_t count = 0;              // after that step, as the log counts
};

struct LeftSteps {
    std::size_t fit = 0;       // so many are as planned, from the first on
    std::string runs;          // which they are of: "frame 12, then its tail"; of several courses: all that fit as far
    std::int64_t unsaid = 0;   // steps missing where one process followed the other
    std::int64_t missing = 0;  // steps missing to the course's end, at least
    std::optional<Misfit> misfit;
};

/// By the course that fits furthest. There is a step and a course.
LeftSteps judge_left(std::span<const SeenStep> steps, std::span<const Course> courses, const LeftBy& by);

}  // namespace lockstep::verification
