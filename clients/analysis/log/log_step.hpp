// Converts and checks one message of steps: damaged numbers are rejected here, so that none overflows later.
#pragma once

#include <cstdint>
#include <expected>
#include <lockstep/step_batch_t.hpp>
#include <string>

#include "clients/analysis/log/step_stream.hpp"

namespace lockstep::analysis {

/// The maximum of ticks, steps, microseconds or messages: 228 years of the shortest tick, since a machine
/// over PTP counts from 1970.
constexpr bool is_countable(std::int64_t number) {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 56;
    return -kFarthest < number && number < kFarthest;
}

/// The number of a message among those of its process.
constexpr bool is_message_number(std::int64_t number) { return number >= 0 && is_countable(number); }

/// In the device's time. The error names the impossible value: ticks that do not rise, directions other than +1 and -1,
/// numbers that are too large, a clock that runs half as fast as another.
std::expected<StepBatch, std::string> to_batch(const step_batch_t& message);

/// The same steps at the ticks of machine time at which they were made, within the batch's clock_error.
StepBatch in_machine_time(StepBatch batch);

}  // namespace lockstep::analysis
