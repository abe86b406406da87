// The steps of several axes in the order of their ticks, from messages of each that come in its own order.
//
// A step waits until nobody can still tell of an earlier one: every 10 ms an axis says what it did, and a message may
// be on its way for longer. Memory is bounded by the steps of that time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "clients/analysis/measured_step.hpp"

namespace lockstep::analysis {

class StepMerge {
public:
    /// So long after a step one of another axis may still be told that was before it. Later ones are told late.
    static constexpr Ticks kPatience{500'000};

    /// A lane for each axis. Its number.
    std::size_t add_lane();
    /// A lane's steps come in the order of their ticks.
    void take(std::size_t lane, std::span<const MeasuredStep> steps);
    /// Calls on_step(lane, step) for what need not wait any longer. Call now and then.
    template <typename OnStep>
    void settle(OnStep&& on_step) {
        tell_before(newest_ - kPatience, on_step);
    }
    /// The same for all.
    template <typename OnStep>
    void finish(OnStep&& on_step) {
        tell_before(newest_ + Ticks{1}, on_step);
    }

private:
    static constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};

    struct Lane {
        std::vector<MeasuredStep> steps;
        std::size_t told = 0;  // of them
    };
    struct Turn {
        std::size_t lane = 0;
        Tick until;  // the next step of any other
    };

    template <typename OnStep>
    void tell_before(Tick end, OnStep& on_step);
    void look_at(std::size_t lane, Tick end);
    Turn next_turn() const;
    void forget_told();

    std::vector<Lane> lanes_;
    std::vector<Tick> next_;  // the next step of each lane; kNever: none before the end
    Tick newest_;
};

/// The lane whose next step is first is told up to the next step of any other.
template <typename OnStep>
void StepMerge::tell_before(Tick end, OnStep& on_step) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) { look_at(i, end); }
    if (lanes_.empty()) { return; }
    for (Turn turn = next_turn(); next_[turn.lane] != kNever; turn = next_turn()) {
        Lane& lane = lanes_[turn.lane];
        do {
            on_step(turn.lane, lane.steps[lane.told++]);
            look_at(turn.lane, end);
        } while (next_[turn.lane] < turn.until);
    }
    forget_told();
}

inline void StepMerge::look_at(std::size_t lane, Tick end) {
    const auto& [steps, told] = lanes_[lane];
    next_[lane] = told < steps.size() && steps[told].tick < end ? steps[told].tick : kNever;
}

inline StepMerge::Turn StepMerge::next_turn() const {
    std::size_t first = 0;
    Tick until = kNever;
    for (std::size_t i = 1; i < next_.size(); ++i) {
        const bool is_first = next_[i] < next_[first];
        until = std::min(until, is_first ? next_[first] : next_[i]);
        first = is_first ? i : first;
    }
    return {first, until};
}

}  // namespace lockstep::analysis
