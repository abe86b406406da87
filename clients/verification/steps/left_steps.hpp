// Compares the steps that an ended process left without a record of their run with everything that its device may have
// run.
//
// The log does not show which frames were armed when the process ended. So each course that the plan allows is made
// again, step by step, and compared with the steps: further frames, or none, and then the tail of the last one.
//
// The next process finds steps in the device that were not read yet, and publishes them as its own, with the device's
// counts. Steps that the ended process had read but not published are missing between them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/verification/steps/seen_step.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

/// Consecutive runs that end at rest, or at the end of the plan.
using Course = std::vector<analysis::Run>;

/// The process that left the steps. The courses follow its runs.
struct LeftBy {
    std::int64_t incarnation = 0;
    std::optional<std::int64_t> zero_count;  // machine coordinates = device count - zero_count; nullopt if not known
};

/// The first step that does not fit a course, as the course has it.
struct Misfit {
    const analysis::Run* run = nullptr;  // the run that the step should belong to; of the given courses
    std::optional<StepEdge> expected;    // nullopt if the course is over
    std::int64_t count = 0;              // after that step, as the log counts
};

struct LeftSteps {
    std::size_t fit = 0;          // how many are as planned, from the first on
    std::string runs;             // their runs: "frame 12, then its tail"; of several courses: all that fit equally far
    std::int64_t unrecorded = 0;  // steps missing between one process and the next
    std::int64_t missing = 0;     // at least so many steps are missing to the course's end
    std::optional<Misfit> misfit;
};

/// Returns the result for the course that fits furthest. There must be a step and a course.
LeftSteps compare_left(std::span<const SeenStep> steps, std::span<const Course> courses, const LeftBy& by);

}  // namespace lockstep::verification
