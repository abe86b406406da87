#include "clients/analysis/measure/step_merge.hpp"

#include <utility>

namespace lockstep::analysis {

std::size_t StepMerge::add_lane() {
    lanes_.emplace_back();
    next_.push_back(kNever);
    return lanes_.size() - 1;
}

void StepMerge::take(std::size_t number, SharedSteps steps) {
    Lane& lane = lanes_[number];
    const StepEdges& edges = steps->edges;
    const Tick newest = edges.back().tick;
    lane.delivered_until = std::max(lane.delivered_until, newest);
    const Tick oldest = edges.front().tick;
    const bool joins = lane.has_steps || !lane.has_count || lane.count == steps->position_before;
    lane.known_from = joins ? std::min(lane.known_from, oldest) : oldest;
    lane.has_steps = true;
    lane.known_until = std::max(lane.known_until, newest);
    lane.count = steps->position_before + edges.change();
    lane.has_count = lane.is_awaited = true;
    lane.lacks_steps = false;
    waiting_ += edges.size();
    lane.steps.add(std::move(steps));
}

void StepMerge::stands(std::size_t number, Tick tick, std::int64_t count) {
    Lane& lane = lanes_[number];
    lane.known_from = std::min(lane.known_from, tick);
    if (!std::exchange(lane.has_count, true)) { lane.count = count; }
    lane.lacks_steps = lane.lacks_steps || lane.count != count;
    if (lane.count != count) { return; }
    if (!lane.lacks_steps) { lane.known_until = std::max(lane.known_until, tick); }
    lane.delivered_until = std::max(lane.delivered_until, tick - kPatience);
    lane.is_awaited = true;
}

Tick StepMerge::settled_until() const {
    Tick until = kNever;
    for (const Lane& lane : lanes_) {
        if (lane.is_awaited) { until = std::min(until, lane.delivered_until); }
    }
    return until;
}

/// Returns false if the merge waits for no lane.
bool StepMerge::give_up_slowest() {
    Lane* slowest = nullptr;
    for (Lane& lane : lanes_) {
        if (lane.is_awaited && (slowest == nullptr || lane.delivered_until < slowest->delivered_until)) {
            slowest = &lane;
        }
    }
    if (slowest == nullptr) { return false; }
    slowest->is_awaited = false;
    return true;
}

}  // namespace lockstep::analysis
