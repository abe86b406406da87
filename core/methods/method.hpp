// The common interface of the published step generation methods: from a planned move to the times of its steps.
//
// Each method is as its authors published it, with their numbers as defaults. `lockstep compare` compares them with
// each other and with the continuous ideal. An axis may make its own moves by any of them (paper_steps.hpp). core/path
// or Lai's planner (core/coordinator/path/lai_path.hpp) plans programs.
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
/// The longest move, in periods of the method's clock.
inline constexpr double kMaxClocks = 5e8;

/// The treatment of a move that a method cannot express: refuse it, or make the nearest move that it can express.
enum class Fit { Exact, Nearest };

struct StepTrain {
    std::vector<double> times_s;  // of each step, from the start of the move
    double clock_s = 0;           // the method's resolution
    std::string nearest;          // the changes made to the move; empty: none
};

using StepResult = std::expected<StepTrain, StepError>;

/// Returns an error for a move that no method can make: no steps, too many, no acceleration, a start speed above the
/// maximum.
std::expected<void, StepError> check(const StepMove& move);

/// Collects all `count` steps from a method's step generator, which has next_s(), clock_s() and nearest() with the
/// meanings of StepTrain.
template <typename Steps>
StepResult train_of(std::expected<Steps, StepError> steps, std::int64_t count) {
    if (!steps) { return std::unexpected(std::move(steps.error())); }
    StepTrain train{.clock_s = steps->clock_s(), .nearest = steps->nearest()};
    train.times_s.reserve(static_cast<std::size_t>(count));
    while (std::ssize(train.times_s) < count) { train.times_s.push_back(steps->next_s()); }
    return train;
}

/// Returns an error if the move takes more than kMaxClocks periods of a clock of `clock_s`.
std::expected<void, StepError> check_length(const StepMove& move, double clock_s);

}  // namespace lockstep::methods
