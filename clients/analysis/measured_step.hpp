// A step and what was measured there: what an axis's own stream of steps gives to those who look at all axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/units.hpp"

namespace lockstep::analysis {

struct MeasuredStep {
    Tick tick;
    std::int64_t count = 0;    // after it, machine coordinates
    float steps_per_tick = 0;  // amounts; 0 where too few steps are known
    float steps_per_tick2 = 0;
    std::int8_t direction = 0;
};

class MeasuredListener {
public:
    virtual ~MeasuredListener() = default;
    /// A lane is an axis, by number. The steps are in their order; their ticks are machine time within clock_error.
    virtual void on_measured(std::size_t lane, std::span<const MeasuredStep> steps, Ticks clock_error) = 0;
};

}  // namespace lockstep::analysis
