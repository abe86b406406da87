// Steps with their measured values, passed from the stream of one axis to the stages for all axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "services/record/reading/recycled.hpp"
#include "services/record/reading/step_edges.hpp"

namespace lockstep::analysis {

/// At a step, without sign; 0 if too few steps are known.
struct StepRates {
    float steps_per_tick = 0;
    float steps_per_tick2 = 0;
};

struct MeasuredStep {
    Tick tick;
    std::int64_t count = 0;  // after the step, machine coordinates
    std::int8_t direction = 0;
    StepRates rates;
};

/// Steps in order. Their ticks are machine time within clock_error.
struct MeasuredSteps {
    MeasuredSteps() = default;
    MeasuredSteps(const MeasuredSteps&) = delete;
    MeasuredSteps& operator=(const MeasuredSteps&) = delete;
    MeasuredSteps(MeasuredSteps&&) = default;
    MeasuredSteps& operator=(MeasuredSteps&&) = delete;
    ~MeasuredSteps() { Recycled<StepRates>::give(std::move(rates)); }

    StepEdges edges;  // at least one
    std::int64_t position_before = 0;
    std::vector<StepRates> rates;  // of each step
    Ticks clock_error;
};

/// Steps are measured once. Any stage on any thread may read them.
using SharedSteps = std::shared_ptr<const MeasuredSteps>;

class MeasuredListener {
public:
    virtual ~MeasuredListener() = default;
    /// A lane is the number of an axis.
    virtual void on_measured(std::size_t lane, const SharedSteps& steps) = 0;
};

}  // namespace lockstep::analysis
