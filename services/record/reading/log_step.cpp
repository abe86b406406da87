#include "services/record/reading/log_step.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
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

bool is_one_way(std::span<const std::int8_t> directions) {
    std::int8_t others = 0;
    for (const std::int8_t direction : directions) { others |= static_cast<std::int8_t>(direction ^ directions[0]); }
    return others == 0;
}

/// Whether all steps are within the reach of a StepBuffer. Messages are sent every 10 ms.
bool are_near(std::span<const std::int32_t> deltas) {
    return std::accumulate(deltas.begin(), deltas.end(), std::int64_t{0}) < StepBuffer::kReach.value;
}

/// The steps of a message that was checked.
StepBuffer steps_of(const step_batch_t& message) {
    std::vector<std::int32_t> ticks = Recycled<std::int32_t>::take(message.delta_ticks.size());
    std::int32_t tick = 0;
    for (std::size_t i = 0; i < ticks.size(); ++i) { ticks[i] = tick += message.delta_ticks[i]; }
    std::vector<std::int8_t> directions;
    if (!is_one_way(message.direction)) { directions.assign(message.direction.begin(), message.direction.end()); }
    return {Tick{message.first_tick}, std::move(ticks), message.direction[0], std::move(directions)};
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
    if (!are_near(message.delta_ticks)) { return std::unexpected("a message of steps that last too long"); }
    batch.steps = StepEdges(steps_of(message));
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
    batch.device_steps = batch.steps;
    StepBuffer steps;
    steps.begin(time.at(batch.device_steps.front().tick));
    for (const StepEdge& step : batch.device_steps) { steps.add({time.at(step.tick), step.direction}); }
    batch.steps = StepEdges(std::move(steps));
    batch.ahead_first = batch.ahead_last = {};
    return batch;
}

}  // namespace lockstep::analysis
