// Merges the ordered steps of several axes into one stream in the order of their ticks.
//
// A step waits until no axis can deliver an earlier one any more. An axis has delivered all steps up to its newest
// step, and up to an instant at which its reported position still was the position after that step. The merge therefore
// waits for an axis that is late because its process or its messages stalled, but not for an axis at rest. Memory is
// bounded: if too many steps wait, the merge no longer waits for the slowest axis until this axis delivers steps again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "clients/analysis/measure/step_queue.hpp"

namespace lockstep::analysis {

class StepMerge {
public:
    /// An improving clock estimate may date a step this much before the instant at which the axis stood still.
    static constexpr Ticks kPatience{500'000};
    /// The maximum number of waiting steps (128 MB).
    static constexpr std::size_t kMaxWaiting = std::size_t{1} << 22;

    explicit StepMerge(std::size_t max_waiting = kMaxWaiting) : max_waiting_(max_waiting) {}

    /// Adds a lane for an axis and returns its number.
    std::size_t add_lane();
    /// A lane's steps come in the order of their ticks.
    void take(std::size_t lane, SharedSteps steps);
    /// The axis reports its position at a tick.
    void stands(std::size_t lane, Tick tick, std::int64_t count);
    /// Messages of the axis are missing after the last one, so it may have moved away and back.
    void lost(std::size_t lane) { lanes_[lane].lacks_steps = true; }
    /// Between these times the log has all of the axis's motion, except for gaps.
    Tick known_from(std::size_t lane) const { return lanes_[lane].known_from; }
    Tick known_until(std::size_t lane) const { return lanes_[lane].known_until; }
    /// Calls on_step(lane, step) for the steps before `end` that need not wait any longer. Call from time to time.
    template <typename OnStep>
    void settle(Tick end, OnStep&& on_step) {
        deliver_before(std::min(end, settled_until()), on_step);
        while (waiting_ > max_waiting_ && give_up_slowest()) { deliver_before(settled_until(), on_step); }
    }
    /// Calls on_step(lane, step) for all remaining steps.
    template <typename OnStep>
    void finish(OnStep&& on_step) {
        deliver_before(kNever, on_step);
    }

private:
    static constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};

    struct Lane {
        StepQueue steps;
        Tick delivered_until;  // the axis has delivered all its steps before this
        Tick known_from = kNever;
        Tick known_until;        // its newest step, or a later instant with the same position
        std::int64_t count = 0;  // after its newest step; without steps, its first known position
        bool has_count = false;
        bool has_steps = false;
        bool lacks_steps = false;  // it had another position since its newest step, or may have
        bool is_awaited = true;
    };
    struct Turn {
        std::size_t lane = 0;
        Tick until;  // tick of the next step of any other lane
    };

    Tick settled_until() const;
    bool give_up_slowest();
    template <typename OnStep>
    void deliver_before(Tick end, OnStep& on_step);
    void look_at(std::size_t lane, Tick end);
    Turn next_turn() const;

    std::size_t max_waiting_;
    std::size_t waiting_ = 0;
    std::vector<Lane> lanes_;
    std::vector<Tick> next_;  // tick of each lane's next step; kNever: none before the end
};

/// Repeatedly selects the lane with the earliest next step, and delivers its steps up to the next step of any other.
template <typename OnStep>
void StepMerge::deliver_before(Tick end, OnStep& on_step) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) { look_at(i, end); }
    if (lanes_.empty()) { return; }
    for (Turn turn = next_turn(); next_[turn.lane] != kNever; turn = next_turn()) {
        StepQueue& steps = lanes_[turn.lane].steps;
        do {
            on_step(turn.lane, steps.front());
            steps.pop();
            --waiting_;
            look_at(turn.lane, end);
        } while (next_[turn.lane] < turn.until);
    }
}

inline void StepMerge::look_at(std::size_t lane, Tick end) {
    const StepQueue& steps = lanes_[lane].steps;
    next_[lane] = !steps.empty() && steps.tick() < end ? steps.tick() : kNever;
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
