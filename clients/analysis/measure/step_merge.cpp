#include "clients/analysis/measure/step_merge.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "clients/analysis/vector/lanes.hpp"
#include "services/record/reading/vector_clones.hpp"

namespace lockstep::analysis {
namespace {

constexpr std::size_t kBlock = 8;          // steps that are merged at once
constexpr std::size_t kRoom = 3 * kBlock;  // steps read behind the last one
const MergedStep kLast(Ticks{(std::int64_t{1} << 56) - 1}, 63, -1);
static_assert(sizeof(MergedStep) * kBlock == sizeof(LongLanes));

/// The steps' ticks are `first` later than their offsets.
LOCKSTEP_VECTOR_CLONES
void number_one_way(std::span<const std::int32_t> offsets, Ticks first, std::size_t lane, std::int8_t direction,
                    MergedStep* to) {
    for (const std::int32_t offset : offsets) { *to++ = MergedStep(first + Ticks{offset}, lane, direction); }
}

/// Orders numbers that rise and then fall, or are such numbers in a circle (Batcher's bitonic merge, 1968).
[[gnu::always_inline]] inline void order(LongLanes& numbers) {
    LongLanes others = __builtin_shufflevector(numbers, numbers, 4, 5, 6, 7, 0, 1, 2, 3);
    LongLanes low = others < numbers ? others : numbers;
    LongLanes high = others < numbers ? numbers : others;
    numbers = __builtin_shufflevector(low, high, 0, 1, 2, 3, 12, 13, 14, 15);
    others = __builtin_shufflevector(numbers, numbers, 2, 3, 0, 1, 6, 7, 4, 5);
    low = others < numbers ? others : numbers;
    high = others < numbers ? numbers : others;
    numbers = __builtin_shufflevector(low, high, 0, 1, 10, 11, 4, 5, 14, 15);
    others = __builtin_shufflevector(numbers, numbers, 1, 0, 3, 2, 5, 4, 7, 6);
    low = others < numbers ? others : numbers;
    high = others < numbers ? numbers : others;
    numbers = __builtin_shufflevector(low, high, 0, 9, 2, 11, 4, 13, 6, 15);
}

/// Puts the lowest numbers of two ordered blocks into the first one, and the highest into the second one.
[[gnu::always_inline]] inline void order_both(LongLanes& first, LongLanes& second) {
    const LongLanes falling = __builtin_shufflevector(second, second, 7, 6, 5, 4, 3, 2, 1, 0);
    second = falling < first ? first : falling;
    first = falling < first ? falling : first;
    order(first);
    order(second);
}

/// Merges `size` steps in whole blocks, without branches, which would be mispredicted.
LOCKSTEP_VECTOR_CLONES
void merge_blocks(const MergedStep* a, const MergedStep* b, MergedStep* to, std::size_t size) {
    LongLanes lowest;
    LongLanes highest;
    load(lowest, a);
    load(highest, b);
    a += kBlock;
    b += kBlock;
    for (std::size_t done = 0; done < size; done += kBlock) {
        order_both(lowest, highest);
        store(lowest, to + done);
        const bool is_b = *b < *a;
        load(lowest, is_b ? b : a);
        a += is_b ? 0 : kBlock;
        b += is_b ? kBlock : 0;
    }
}

}  // namespace

void StepMerge::OrderedSteps::resize(std::size_t size) {
    size_ = size;
    steps_.resize(size + kRoom);
    std::fill_n(steps_.end() - kRoom, kRoom, kLast);
}

void StepMerge::OrderedSteps::merge(const OrderedSteps& a, const OrderedSteps& b) {
    resize(a.size() + b.size());
    merge_blocks(a.steps_.data(), b.steps_.data(), steps_.data(), size_);
}

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
        ready_[i] = {steps.ready(), steps.rates(), steps.count(), steps.batch().is_one_way()};
        ready_[i].steps = ready_[i].steps.first(ready_[i].before(end));
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
    const auto& steps = ready_[lane].steps;
    if (steps.empty()) { return; }
    added_.resize(steps.size());
    const StepEdges& batch = lanes_[lane].steps.batch();
    if (batch.is_one_way() && !batch.offsets().empty()) {
        const auto first = static_cast<std::size_t>(steps.data() - batch.begin());
        number_one_way(batch.offsets().subspan(first, steps.size()), batch.front().tick - origin_, lane,
                       batch.front().direction, added_.begin());
    } else {
        std::ranges::transform(steps, added_.begin(), [&](const StepEdge& edge) {
            return MergedStep(edge.tick - origin_, lane, edge.direction);
        });
    }
    if (merged_.empty()) { return std::swap(merged_, added_); }
    std::swap(merged_, before_);
    merged_.merge(before_, added_);
}

/// Drops the delivered steps.
void StepMerge::pop() {
    waiting_ -= merged_.size();
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
        StepQueue& steps = lanes_[i].steps;
        if (steps.empty()) { continue; }
        const MergedSteps::Lane& passed = ready_[i];
        steps.pop(static_cast<std::size_t>(passed.steps.data() - steps.ready().data()), passed.count);
    }
}

}  // namespace lockstep::analysis
