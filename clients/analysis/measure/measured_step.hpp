// A step with its measured values: passed from an axis's own stream of steps to the stages for all axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/units.hpp"

namespace lockstep::analysis {

struct MeasuredStep {
    Tick tick;
    std::int64_t count = 0;    // after it, machine coordinates
    float steps_per_tick = 0;  // amounts; 0 where too few steps are known
    float steps_per_tick2 = 0;
    std::int8_t direction = 0;
};

/// Steps in their order. Their ticks are machine time within clock_error.
struct MeasuredSteps {
    std::vector<MeasuredStep> steps;  // one at least
    Ticks clock_error;
};

/// Measured once, and read by any stage, on any thread.
using SharedSteps = std::shared_ptr<const MeasuredSteps>;

class MeasuredListener {
public:
    virtual ~MeasuredListener() = default;
    /// A lane is an axis, by number.
    virtual void on_measured(std::size_t lane, const SharedSteps& steps) = 0;
};

}  // namespace lockstep::analysis
