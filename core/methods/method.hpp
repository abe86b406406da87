// What the published step generation methods have in common: a planned move in, the times of its steps out.
//
// Each method is as its authors published it, with their numbers as defaults. They are compared with each other and
// with the continuous ideal, and an axis may make its own moves by any of them (paper_steps.hpp). Programs run by
// core/motion, or by Lai's planner (core/coordinator/path/lai_path.hpp).
#pragma once

#include <cstdint>
#include <expected>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "core/motion/step_error.hpp"
#include "core/motion/step_move.hpp"

namespace lockstep::methods {

inline constexpr std::int64_t kMaxSteps = 10'000'000;
/// How many periods of its clock a method is followed for.
inline constexpr double kMaxClocks = 5e8;

/// What to do with a move that a method cannot express: refuse it, or make the nearest it can.
enum class Fit { Exact, Nearest };

struct StepTrain {
    std::vector<double> times_s;  // of each step, from the start of the move
    double clock_s = 0;           // the method's resolution
    std::string nearest;          // what was changed of the move; empty: nothing
};

using StepResult = std::expected<StepTrain, StepError>;

/// Nothing, or what is wrong with the move whatever the method: no steps, too many, no acceleration, a start above the
/// maximum.
std::expected<void, StepError> check(const StepMove& move);

/// The whole train of `count` steps, from a method's own maker of them, one after the other: next_s(), clock_s() and
/// nearest(), as StepTrain has them.
template <typename Steps>
StepResult train_of(std::expected<Steps, StepError> steps, std::int64_t count) {
    if (!steps) { return std::unexpected(std::move(steps.error())); }
    StepTrain train{.clock_s = steps->clock_s(), .nearest = steps->nearest()};
    train.times_s.reserve(static_cast<std::size_t>(count));
    while (std::ssize(train.times_s) < count) { train.times_s.push_back(steps->next_s()); }
    return train;
}

/// Error where following the move by a clock of `clock_s` would take more than kMaxClocks.
std::expected<void, StepError> check_length(const StepMove& move, double clock_s);

}  // namespace lockstep::methods
