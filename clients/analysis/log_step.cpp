#include "clients/analysis/log_step.hpp"

namespace lockstep::analysis {

std::expected<StepBatch, std::string> to_batch(const step_batch_t& message) {
    if (!is_countable(message.first_tick) || !is_countable(message.position_before) || message.sequence < 0 ||
        !is_countable(message.sequence)) {
        return std::unexpected("a message of steps with numbers that no machine counts to");
    }
    StepBatch batch{message.incarnation, message.sequence, message.position_before};
    batch.steps.reserve(message.delta_ticks.size());
    Tick tick{message.first_tick};
    for (std::size_t i = 0; i < message.delta_ticks.size(); ++i) {
        const bool rises = i == 0 ? message.delta_ticks[i] == 0 : message.delta_ticks[i] > 0;
        if (!rises) { return std::unexpected("the ticks of a message's steps do not rise"); }
        const std::int8_t direction = message.direction[i];
        if (direction != 1 && direction != -1) { return std::unexpected("a step is neither forward nor backward"); }
        tick += Ticks{message.delta_ticks[i]};
        batch.steps.push_back({tick, direction});
    }
    return batch;
}

}  // namespace lockstep::analysis
