// Steps like those of a machine, for the tests here.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/step/segment.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::test {

/// `count` steps, `interval` ticks apart, the first at `first`.
inline std::vector<StepEdge> even_steps(std::int64_t first, std::int64_t interval, int count, int direction = 1) {
    std::vector<StepEdge> steps;
    for (int i = 0; i < count; ++i) {
        steps.push_back({Tick{first + i * interval}, static_cast<std::int8_t>(direction)});
    }
    return steps;
}

/// A move from rest to rest: speeds up, cruises, slows down. Step k falls at the first whole tick at or after the
/// instant the position crosses k - 1/2.
inline std::vector<StepEdge> trapezoid(std::int64_t first, double cruise_steps_per_tick, double acceleration,
                                       int count) {
    const double ramp = cruise_steps_per_tick * cruise_steps_per_tick / acceleration / 2;
    const double ramp_time = cruise_steps_per_tick / acceleration;
    const double total_time = 2 * ramp_time + (count - 2 * ramp) / cruise_steps_per_tick;
    std::vector<StepEdge> steps;
    for (int k = 1; k <= count; ++k) {
        const double at = k - 0.5;
        double time = ramp_time + (at - ramp) / cruise_steps_per_tick;
        if (at < ramp) { time = std::sqrt(2 * at / acceleration); }
        if (at > count - ramp) { time = total_time - std::sqrt(2 * (count - at) / acceleration); }
        steps.push_back({Tick{first + static_cast<std::int64_t>(std::ceil(time))}, 1});
    }
    return steps;
}

inline analysis::StepBatch batch(std::int64_t sequence, std::int64_t before, std::vector<StepEdge> steps,
                                 std::int64_t incarnation = 7) {
    return {incarnation, sequence, before, std::move(steps)};
}

}  // namespace lockstep::test
