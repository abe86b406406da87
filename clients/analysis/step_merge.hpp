// The steps of several axes in the order of their ticks, from messages of each that come in its own order.
//
// A step waits until nobody can still tell of an earlier one: every 10 ms an axis says what it did, and a message may
// be on its way for longer. Memory is bounded by the steps of that time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/units.hpp"

namespace lockstep::analysis {

/// A step and what was measured there.
struct MeasuredStep {
    Tick tick;
    std::int64_t count = 0;    // after it, machine coordinates
    float steps_per_tick = 0;  // amounts; 0 where too few steps are known
    float steps_per_tick2 = 0;
    std::int8_t direction = 0;
};

class MergedStepListener {
public:
    virtual ~MergedStepListener() = default;
    virtual void on_step(std::size_t lane, const MeasuredStep& step) = 0;
};

class StepMerge {
public:
    /// So long after a step one of another axis may still be told that was before it. Later ones are told late.
    static constexpr Ticks kPatience{500'000};

    explicit StepMerge(MergedStepListener& listener) : listener_(listener) {}

    /// A lane for each axis. Its number.
    std::size_t add_lane();
    /// A lane's steps come in the order of their ticks.
    void take(std::size_t lane, const MeasuredStep& step);
    /// Tells what need not wait any longer. Call now and then.
    void settle() { tell_before(newest_ - kPatience); }
    /// Tells all.
    void finish() { tell_before(newest_ + Ticks{1}); }

private:
    struct Lane {
        std::vector<MeasuredStep> steps;
        std::size_t told = 0;  // of them
        bool empty() const { return told == steps.size(); }
        Tick next() const { return steps[told].tick; }
    };

    void tell_before(Tick end);

    MergedStepListener& listener_;
    std::vector<Lane> lanes_;
    Tick newest_;
};

}  // namespace lockstep::analysis
