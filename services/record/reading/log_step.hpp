// Converts and checks one message of steps. Damaged numbers are rejected here, so that later code cannot overflow.
#pragma once

#include <cstdint>
#include <expected>
#include <lockstep/step_batch_t.hpp>
#include <string>

#include "services/record/reading/step_stream.hpp"

namespace lockstep::analysis {

/// Whether a number of ticks, steps, microseconds or messages is within the limit: 228 years of the shortest tick,
/// because a machine over PTP counts from 1970.
constexpr bool is_countable(std::int64_t number) {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 56;
    return -kFarthest < number && number < kFarthest;
}

/// Whether this can be the number of a message of a process; each process counts from 0.
constexpr bool is_message_number(std::int64_t number) { return number >= 0 && is_countable(number); }

/// Returns the batch in device time. The error names the impossible value: ticks that do not rise, directions other
/// than +1 and -1, numbers that are too large, or clocks that differ by more than 1 %.
std::expected<StepBatch, std::string> to_batch(const step_batch_t& message);

/// A message of steps and what it contains, converted once for all readers.
struct StepMessage {
    std::string machine;
    std::string axis;
    std::int64_t utime = 0;
    std::expected<StepBatch, std::string> batch;
};
StepMessage to_step_message(const step_batch_t& message);

/// Returns the same steps in machine time, exact within the batch's clock_error.
StepBatch in_machine_time(StepBatch batch);

}  // namespace lockstep::analysis
