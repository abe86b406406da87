// Checks whether a method can make an axis's own moves within the axis's limits.
//
// A method that only does not use a limit suits: spielauer starts at rest at any start velocity, lai uses the smaller
// of acceleration and deceleration. A method that would break a limit, or cannot make the speed at all, does not suit.
// To check its ramps, LimitWatch (limit_watch.hpp) checks moves of many lengths, from one step to a long one.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>

#include "core/machine.hpp"
#include "core/motion/step_error.hpp"

namespace lockstep::methods {

/// Steps/s, steps/s^2, and the tick in s to which step times are rounded.
struct SpeedLimits {
    double start = 0;
    double max = 0;
    double acceleration = 0;
    double deceleration = 0;
    double tick_s = 0;
};

SpeedLimits speed_limits_of(const Moving auto& part, std::int64_t tick_ns) {
    return {.start = part.start_velocity_mm_s * part.steps_per_mm,
            .max = part.max_velocity_mm_s * part.steps_per_mm,
            .acceleration = part.max_accel_mm_s2 * part.steps_per_mm,
            .deceleration = part.max_decel_mm_s2 * part.steps_per_mm,
            .tick_s = static_cast<double>(tick_ns) * 1e-9};
}

/// Why a method does not suit an axis.
struct Unsuited {
    enum class Why : std::uint8_t {
        TooFast,          // `value` steps/s; steps rounded to ticks allow `limit`
        OneAcceleration,  // the deceleration of `value` steps/s^2 is not the acceleration `limit`
        WholePulses,      // `value` steps/s^2 is less than one pulse per period^2, `limit`
        NotMade,          // a move that was tried cannot be made: `error`
        BreaksLimits,     // a move of `steps` that was tried changes its speed by `value` steps/s more than the
                          // acceleration allows; the start velocity allows `limit`
    };
    Why why;
    double value = 0;
    double limit = 0;
    std::int64_t steps = 0;
    std::optional<StepError> error;
};

/// Text for a person: the reason, with the value and the limit, and what would help.
std::string text_of(const Unsuited& unsuited);

std::expected<void, Unsuited> suits(StepMethod method, const SpeedLimits& limits);

}  // namespace lockstep::methods
