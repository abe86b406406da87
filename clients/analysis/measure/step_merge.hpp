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

#include "clients/analysis/measure/merged_steps.hpp"
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
    /// Calls on_steps(MergedSteps) with the steps before `end` that need not wait any longer. It must pass all of them.
    /// Call from time to time.
    template <typename OnSteps>
    void settle(Tick end, OnSteps&& on_steps) {
        deliver_before(std::min(end, settled_until()), on_steps);
        while (waiting_ > max_waiting_ && give_up_slowest()) { deliver_before(settled_until(), on_steps); }
    }
    /// Calls on_steps(MergedSteps) with all remaining steps.
    template <typename OnSteps>
    void finish(OnSteps&& on_steps) {
        deliver_before(kNever, on_steps);
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
    Tick settled_until() const;
    bool give_up_slowest();
    template <typename OnSteps>
    void deliver_before(Tick end, OnSteps& on_steps);
    bool merge_before(Tick end);
    Tick end_of_ready(Tick end) const;
    void add(std::size_t lane);
    void pop();

    std::size_t max_waiting_;
    std::size_t waiting_ = 0;
    std::vector<Lane> lanes_;
    // The steps being delivered.
    std::vector<MergedSteps::Lane> ready_;
    std::vector<MergedStep> merged_;
    std::vector<MergedStep> added_;   // of the lane added last
    std::vector<MergedStep> before_;  // merged_, without them
    Tick origin_;                     // of their ticks
};

template <typename OnSteps>
void StepMerge::deliver_before(Tick end, OnSteps& on_steps) {
    while (merge_before(end)) {
        on_steps(MergedSteps(origin_, merged_, ready_));
        pop();
    }
}

}  // namespace lockstep::analysis
