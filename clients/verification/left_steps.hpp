// Compares the steps that a process left without the record of their run at its end with all that its device may have
// run.
//
// The log does not show which frames were armed at its end. So each course that the plan allows is made again, step
// by step, and the steps decide: the frames to come one after the other, and after any of them its tail.
//
// The next process finds steps in the device that were not read yet, and publishes them as its own, with the device's
// counts. Steps that the previous process had read and not published are missing between.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/analysis/log/run.hpp"
#include "clients/verification/seen_step.hpp"

namespace lockstep::verification {

/// Runs one after the other that end at rest, or at the end of the plan.
using Course = std::vector<analysis::Run>;

/// The process whose runs the courses follow.
struct LeftBy {
    std::int64_t incarnation = 0;
    std::optional<std::int64_t> zero_count;  // machine coordinates = device count - zero_count; none: not known
};

/// The first step that does not fit, with the one that the course has there.
struct Misfit {
    const analysis::Run* run = nullptr;  // the run it should belong to; of the given courses
    std::optional<StepEdge> expected;    // none: the course is over
    std::int64_t count = 0;              // after that step, as the log counts
};

struct LeftSteps {
    std::size_t fit = 0;          // how many are as planned, from the first on
    std::string runs;             // their runs: "frame 12, then its tail"; of several courses: all that fit equally far
    std::int64_t unrecorded = 0;  // steps missing between one process and the next
    std::int64_t missing = 0;     // steps missing to the course's end, at least
    std::optional<Misfit> misfit;
};

/// With the course that fits furthest. There must be a step and a course.
LeftSteps compare_left(std::span<const SeenStep> steps, std::span<const Course> courses, const LeftBy& by);

}  // namespace lockstep::verification
