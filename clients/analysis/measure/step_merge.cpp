#include "clients/analysis/measure/step_merge.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace lockstep::analysis {
namespace {

/// Merges from both ends at once: each end waits for its own comparisons only. Has no other branches, which would be
/// mispredicted.
void merge(std::span<const MergedStep> a, std::span<const MergedStep> b, MergedStep* to) {
    MergedStep* end = to + a.size() + b.size();
    while (!a.empty() && !b.empty()) {
        const MergedStep* first_a = a.data();
        const MergedStep* first_b = b.data();
        const MergedStep* last_a = &a.back();
        const MergedStep* last_b = &b.back();
        for (std::size_t both = std::min(a.size(), b.size()); both > 0; --both) {
            const bool is_b = *first_b < *first_a;
            *to++ = is_b ? *first_b : *first_a;
            first_a += static_cast<std::ptrdiff_t>(!is_b);
            first_b += static_cast<std::ptrdiff_t>(is_b);
            const bool is_a = *last_b < *last_a;
            *--end = is_a ? *last_a : *last_b;
            last_a -= static_cast<std::ptrdiff_t>(is_a);
            last_b -= static_cast<std::ptrdiff_t>(!is_a);
        }
        a = {first_a, last_a + 1};
        b = {first_b, last_b + 1};
    }
    std::ranges::copy(b, std::ranges::copy(a, to).out);
}

}  // namespace

std::size_t StepMerge::add_lane() {
    lanes_.emplace_back();
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

/// Merges steps before `end`, as many as every lane has in one message. Returns false if there are none.
bool StepMerge::merge_before(Tick end) {
    origin_ = end = end_of_ready(end);
    ready_.resize(lanes_.size());
    merged_.clear();
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
        const StepQueue& steps = lanes_[i].steps;
        if (steps.empty()) {
            ready_[i] = {.count = lanes_[i].count};
            continue;
        }
        ready_[i] = {steps.ready(), steps.rates(), steps.count()};
        ready_[i].steps = ready_[i].steps.first(ready_[i].steps.before(end));
        add(i);
    }
    return !merged_.empty();
}

/// Limits `end` to the steps of each lane's first message.
Tick StepMerge::end_of_ready(Tick end) const {
    for (const Lane& lane : lanes_) {
        if (!lane.steps.empty()) { end = std::min(end, lane.steps.ready().back().tick + Ticks{1}); }
    }
    return end;
}

/// Adds the ready steps of a lane.
void StepMerge::add(std::size_t lane) {
    const StepSpan& steps = ready_[lane].steps;
    if (steps.empty()) { return; }
    added_.resize(steps.size());
    const Ticks later = steps.origin() - origin_;
    if (steps.is_one_way()) {
        const MergedStep at_origin(later, lane, steps.direction(0));
        for (std::size_t i = 0; i < steps.size(); ++i) { added_[i] = at_origin.after(Ticks{steps.ticks()[i]}); }
    } else {
        for (std::size_t i = 0; i < steps.size(); ++i) {
            added_[i] = MergedStep(later + Ticks{steps.ticks()[i]}, lane, steps.direction(i));
        }
    }
    if (merged_.empty()) { return std::swap(merged_, added_); }
    std::swap(merged_, before_);
    merged_.resize(before_.size() + added_.size());
    merge(before_, added_, merged_.data());
}

/// Drops the delivered steps.
void StepMerge::pop() {
    waiting_ -= merged_.size();
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
        StepQueue& steps = lanes_[i].steps;
        if (steps.empty()) { continue; }
        const MergedSteps::Lane& passed = ready_[i];
        steps.pop(static_cast<std::size_t>(passed.steps.ticks() - steps.ready().ticks()), passed.count);
    }
}

}  // namespace lockstep::analysis
