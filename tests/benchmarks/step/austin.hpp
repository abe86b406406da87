// The code that a user would write first: David Austin's recurrence, "Generate stepper-motor speed profiles in real
// time", as in Arduino libraries: the next interval from the previous one with a division, c -= 2c / (4n + 1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/benchmarks/step/moves.hpp"

namespace lockstep::bench {

/// Calls on_step(time in ticks) for every step.
template <typename OnStep>
void austin(const Limits& limits, OnStep&& on_step) {
    const auto at = [&](double v) -> std::int64_t { return std::llround(v * v / (2 * limits.acceleration)); };
    const std::int64_t first = at(limits.start_velocity);
    const std::int64_t ramp = std::min(at(limits.max_velocity) - first, limits.steps / 2);
    double interval = kTicksPerSecond / limits.start_velocity;
    double time = 0;
    for (std::int64_t k = 1; k <= limits.steps; ++k) {
        time += interval;
        on_step(static_cast<std::int64_t>(time));
        if (k <= ramp) {
            interval -= 2 * interval / static_cast<double>(4 * (first + k) + 1);
        } else if (k > limits.steps - ramp) {
            interval += 2 * interval / static_cast<double>(4 * (first + limits.steps - k) + 1);
        }
    }
}

}  // namespace lockstep::bench
