#include "services/record/reading/log_step.hpp"

#include <cstdlib>
#include <utility>
#include <vector>

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
    std::vector<StepEdge> steps(message.delta_ticks.size());
    Tick tick{message.first_tick};
    bool rises = steps.empty() || message.delta_ticks[0] == 0;
    bool has_directions = true;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const std::int8_t direction = message.direction[i];
        rises = rises && (message.delta_ticks[i] > 0 || i == 0);
        has_directions = has_directions && (direction == 1 || direction == -1);
        tick += Ticks{message.delta_ticks[i]};
        steps[i] = {tick, direction};
    }
    if (!rises) { return std::unexpected("the ticks of a message's steps do not rise"); }
    if (!has_directions) { return std::unexpected("a step is neither forward nor backward"); }
    batch.steps = std::move(steps);
    if (!batch.steps.empty() && !clocks_agree(batch.machine_time())) {
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
