#include "services/record/reading/log_step.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "services/record/reading/recycled.hpp"

namespace lockstep::analysis {
namespace {

bool is_countable_batch(const step_batch_t& m) {
    return is_countable(m.first_tick) && is_countable(m.position_before) && is_message_number(m.sequence) &&
           is_countable(m.ahead_first) && is_countable(m.ahead_last) && is_countable(m.clock_error) &&
           m.clock_error >= 0;
}

/// Allows a difference of 1 %, more than the error of any quartz. Steps, at least two ticks apart, remain distinct.
bool clocks_agree(const ClockStretch& time) {
    constexpr std::int64_t kLeastPart = 100;
    return std::abs((time.other_ticks - time.ticks).value) <= 2 + time.ticks.value / kLeastPart;
}

// Loops without branches, which the compiler turns into vector instructions.

/// Whether the first step, of at least one, is at the message's tick, and each further one later than the one before.
bool do_rise(std::span<const std::int32_t> deltas) {
    std::int32_t least = 1;
    for (const std::int32_t delta : deltas.subspan(1)) { least = std::min(least, delta); }
    return deltas[0] == 0 && least > 0;
}

bool are_directions(std::span<const std::int8_t> directions) {
    std::int8_t others = 0;
    for (const std::int8_t direction : directions) {
        others |= static_cast<std::int8_t>((direction != 1 ? 1 : 0) & (direction != -1 ? 1 : 0));
    }
    return others == 0;
}

}  // namespace

std::expected<StepBatch, std::string> to_batch(const step_batch_t& message) {
    if (!is_countable_batch(message)) { return std::unexpected("a message of steps with impossible numbers"); }
    StepBatch batch{.incarnation = message.incarnation,
                    .sequence = message.sequence,
                    .position_before_steps = message.position_before,
                    .steps = {},
                    .ahead_first = {message.ahead_first},
                    .ahead_last = {message.ahead_last},
                    .clock_error = {message.clock_error}};
    if (message.delta_ticks.empty()) { return std::unexpected("a message of steps without a step"); }
    if (!do_rise(message.delta_ticks)) { return std::unexpected("the ticks of a message's steps do not rise"); }
    if (!are_directions(message.direction)) { return std::unexpected("a step is neither forward nor backward"); }
    std::vector<StepEdge> steps = Recycled<StepEdge>::take(message.delta_ticks.size());
    std::int64_t tick = message.first_tick;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        tick += message.delta_ticks[i];
        steps[i] = {Tick{tick}, message.direction[i]};
    }
    batch.steps = std::move(steps);
    if (!clocks_agree(batch.machine_time())) {
        return std::unexpected("the clocks of a message of steps differ by an impossible amount");
    }
    return batch;
}

StepMessage to_step_message(const step_batch_t& message) {
    return {message.machine, message.axis, message.utime, to_batch(message)};
}

StepBatch in_machine_time(StepBatch batch) {
    if (batch.steps.empty() || (batch.ahead_first == Ticks{} && batch.ahead_last == Ticks{})) { return batch; }
    const ClockStretch time = batch.machine_time();
    std::vector<StepEdge> steps(batch.steps.begin(), batch.steps.end());
    for (StepEdge& step : steps) {
        batch.device_ticks.push_back(step.tick);
        step.tick = time.at(step.tick);
    }
    batch.steps = std::move(steps);
    batch.ahead_first = batch.ahead_last = {};
    return batch;
}

}  // namespace lockstep::analysis
