#include "services/record/reading/positions/recorded_position.hpp"

#include "services/record/reading/log_step.hpp"

namespace lockstep::analysis {

std::optional<RecordedPosition> to_position(const axis_position_t& message) {
    if (!is_countable(message.tick) || !is_countable(message.position_steps) ||
        !is_countable(message.following_error_steps) || !is_message_number(message.sequence)) {
        return std::nullopt;
    }
    return RecordedPosition{.tick = Tick{message.tick},
                            .steps = message.position_steps,
                            .mm = message.position_mm,
                            .velocity_mm_per_s = message.velocity_mm_per_s,
                            .incarnation = message.incarnation,
                            .sequence = message.sequence,
                            .is_homed = message.homed != 0,
                            .has_fault = message.fault != 0,
                            .following_error = message.following_error_steps};
}

}  // namespace lockstep::analysis
