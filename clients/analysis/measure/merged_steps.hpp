// Steps of several axes in the order of their ticks, and where each axis is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "clients/analysis/measure/measured_step.hpp"

namespace lockstep::analysis {

/// A step of one of at most 64 lanes, in one number: the numbers are in the order of ticks, then of lanes.
class MergedStep {
public:
    MergedStep() = default;
    /// `tick` counts from the origin of MergedSteps, and is within +-2^56.
    MergedStep(Ticks tick, std::size_t lane, std::int8_t direction)
        : number_(tick.value * kUnit + static_cast<std::int64_t>(2 * lane) + (direction < 0 ? 1 : 0)) {}

    /// A step of the same kind, by so many ticks later.
    MergedStep after(Ticks ticks) const {
        MergedStep later = *this;
        later.number_ += ticks.value * kUnit;
        return later;
    }

    Ticks tick() const { return {number_ >> kBits}; }
    std::size_t lane() const { return static_cast<std::size_t>(number_ & (kUnit - 1)) / 2; }
    std::int8_t direction() const { return (number_ & 1) != 0 ? -1 : 1; }
    /// Twice the lane, plus 1 if backward.
    std::size_t kind() const { return static_cast<std::size_t>(number_ & (kUnit - 1)); }
    bool operator<(const MergedStep& other) const { return number_ < other.number_; }

private:
    static constexpr int kBits = 7;
    static constexpr std::int64_t kUnit = std::int64_t{1} << kBits;
    std::int64_t number_ = 0;
};

/// Each lane's steps are consecutive and of one message. Readers pass them from the front.
class MergedSteps {
public:
    /// The steps of a lane that were not passed.
    struct Lane {
        StepSpan steps;
        const StepRates* rates = nullptr;  // of these steps
        std::int64_t count = 0;            // the position before them

        void pass(std::size_t passed) {
            count += steps.first(passed).change();
            steps = steps.subspan(passed);
            rates += passed;
        }
    };

    /// `steps` are those of all lanes, in order. Both must outlive this object.
    MergedSteps(Tick origin, std::span<const MergedStep> steps, std::span<Lane> lanes)
        : origin_(origin), steps_(steps), lanes_(lanes) {}

    bool empty() const { return steps_.empty(); }
    /// Of the first step.
    Tick tick() const { return origin_ + steps_.front().tick(); }
    std::size_t lane() const { return steps_.front().lane(); }
    std::span<const Lane> lanes() const { return lanes_; }
    Tick tick_of(const MergedStep& step) const { return origin_ + step.tick(); }
    /// The steps before a tick.
    std::span<const MergedStep> before(Tick tick) const {
        if (steps_.empty() || origin_ + steps_.back().tick() < tick) { return steps_; }
        return {steps_.begin(), std::ranges::lower_bound(steps_, tick - origin_, {}, &MergedStep::tick)};
    }
    void pass_before(Tick tick) {
        steps_ = steps_.subspan(before(tick).size());
        for (Lane& lane : lanes_) { lane.pass(lane.steps.before(tick)); }
    }
    /// Passes the first step and returns it.
    MeasuredStep pop() {
        const MergedStep& step = steps_.front();
        Lane& lane = lanes_[step.lane()];
        const StepRates rates = *lane.rates;
        const Tick tick = this->tick();
        lane.pass(1);
        steps_ = steps_.subspan(1);
        return {tick, lane.count, step.direction(), rates};
    }

private:
    Tick origin_;
    std::span<const MergedStep> steps_;
    std::span<Lane> lanes_;
};

}  // namespace lockstep::analysis
