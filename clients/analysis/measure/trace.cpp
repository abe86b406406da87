#include "clients/analysis/measure/trace.hpp"

#include "clients/analysis/vector/lanes.hpp"
#include "services/record/reading/vector_clones.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace lockstep::analysis {
namespace {

// An interval this many times longer than the previous one contains a rest.
constexpr std::int64_t kRestRatio = 4;
/// The steps of the batch before a block, whose intervals tell whether the axis rests.
constexpr std::size_t kBefore = 2;

/// Of several points at once: their slopes, and those of lines that still pass them.
struct Slopes {
    DoubleLanes lowest;
    DoubleLanes highest;
    DoubleLanes low;
    DoubleLanes high;

    [[gnu::always_inline]] void add(const Slopes& other) {
        lowest = other.lowest < lowest ? other.lowest : lowest;
        highest = other.highest > highest ? other.highest : highest;
        low = other.low > low ? other.low : low;
        high = other.high < high ? other.high : high;
    }
};

constexpr DoubleLanes kPlaces{0, 1, 2, 3, 4, 5, 6, 7};

/// Whether the axis does not rest before any step of a block. `block`: the steps' ticks.
[[gnu::always_inline]] inline bool goes_on(const std::int32_t* block) {
    constexpr std::int32_t kLongest = std::numeric_limits<std::int32_t>::max() / (2 * kRestRatio);
    IntLanes ticks;
    IntLanes before;
    IntLanes earlier;
    load(ticks, block);
    load(before, block - 1);
    load(earlier, block - 2);
    const IntLanes previous = before - earlier;
    const IntLanes rest = ticks - before - previous * static_cast<std::int32_t>(kRestRatio);
    const IntLanes excess = previous - kLongest;
    return all_true((rest > excess ? rest : excess) < 0);
}

double ticks_between(Tick from, Tick to) { return static_cast<double>(to.value - from.value); }

}  // namespace

void Trace::on_batch(const StepBatch& batch) {
    const StepEdges& steps = batch.steps;
    position_ = batch.position_before_steps;
    const bool has_blocks = steps.is_one_way() && !steps.offsets().empty();
    for (std::size_t i = 0; i < steps.size();) {
        if (has_blocks && i >= kBefore && i + kBlock <= steps.size() && block(steps, i)) {
            i += kBlock;
            continue;
        }
        for (const std::size_t end = std::min(i + (i < kBefore ? kBefore : kBlock), steps.size()); i < end; ++i) {
            step(steps[i], position_);
            position_ += steps[i].direction;
        }
    }
}

/// Takes a block of steps, from `first` on, as step() does, but all at once, which costs less. Returns false and takes
/// none if the current line might not pass all of them, or if the axis might have rested.
LOCKSTEP_VECTOR_CLONES
bool Trace::block(const StepEdges& steps, std::size_t first) {
    const std::int32_t* const block = &steps.offsets()[first];
    if (!newest_ || last_interval_ == Ticks{} || !goes_on(block)) { return false; }
    const Knot& anchor = knots_.back();
    const std::int64_t direction = steps.front().direction;
    const double sign = static_cast<double>(direction);
    const double position = static_cast<double>(position_) + sign * 0.5 - anchor.position_steps;
    const double begin = ticks_between(anchor.tick, steps.front().tick);
    Slopes slopes[2];
    for (std::size_t half = 0; half < 2; ++half) {
        HalfIntLanes offset;
        load(offset, block + half * kBlock / 2);
        const DoubleLanes time = begin + __builtin_convertvector(offset, DoubleLanes);
        const DoubleLanes passed = kPlaces + static_cast<double>(half * kBlock / 2);
        const DoubleLanes half_angle = tolerance_ / time;
        const DoubleLanes slope = (position + sign * passed) / time;
        slopes[half] = {slope, slope, slope - half_angle, slope + half_angle};
    }
    slopes[0].add(slopes[1]);
    const double low = std::max(low_slope_, highest_of(slopes[0].low));
    const double high = std::min(high_slope_, lowest_of(slopes[0].high));
    if (lowest_of(slopes[0].lowest) < low || highest_of(slopes[0].highest) > high) { return false; }
    low_slope_ = low;
    high_slope_ = high;
    position_ += direction * static_cast<std::int64_t>(kBlock);
    last_step_ = steps[first + kBlock - 1].tick;
    last_interval_ = Ticks{block[kBlock - 1] - block[kBlock - 2]};
    newest_ = Knot{*last_step_, static_cast<double>(position_ - direction) + sign * 0.5};
    return true;
}

void Trace::on_break(const Break&) { finish(); }

void Trace::finish() {
    if (last_step_) {
        point(*last_step_ + Ticks{std::max<std::int64_t>(1, last_interval_.value / 2)}, static_cast<double>(position_));
    }
    end_line();
    joined_ = false;
    last_step_.reset();
    last_interval_ = {};
}

void Trace::step(StepEdge edge, std::int64_t position_before) {
    if (last_step_) {
        const Ticks interval = edge.tick - *last_step_;
        const bool rested = last_interval_.value >= 2 && interval >= last_interval_ * kRestRatio;
        if (rested) { rest(edge.tick, position_before); }
        last_interval_ = rested ? Ticks{} : interval;
    }
    point(edge.tick, static_cast<double>(position_before) + edge.direction * 0.5);
    last_step_ = edge.tick;
}

/// The axis rested on a whole step before its step at `until`. Two points mark the rest.
void Trace::rest(Tick until, std::int64_t position) {
    const Ticks half{last_interval_.value / 2};
    point(*last_step_ + half, static_cast<double>(position));
    point(until - half, static_cast<double>(position));
}

void Trace::point(Tick tick, double position) {
    if (!std::exchange(joined_, true)) {
        keep({tick, position, false});
        return;
    }
    const Knot& anchor = knots_.back();
    const double time = ticks_between(anchor.tick, tick);
    const double slope = (position - anchor.position_steps) / time;
    if (newest_ && (slope < low_slope_ || slope > high_slope_)) {
        end_line();
        point(tick, position);
        return;
    }
    const double half_angle = tolerance_ / time;
    low_slope_ = newest_ ? std::max(low_slope_, slope - half_angle) : slope - half_angle;
    high_slope_ = newest_ ? std::min(high_slope_, slope + half_angle) : slope + half_angle;
    newest_ = Knot{tick, position};
}

void Trace::end_line() {
    if (newest_) { keep(*std::exchange(newest_, std::nullopt)); }
}

void Trace::keep(Knot knot) {
    knots_.push_back(knot);
    if (knots_.size() >= max_knots_) { thin_out(); }
}

/// Repeats the thinning over the knots with twice the tolerance. The errors add up.
void Trace::thin_out() {
    Trace coarser(std::numeric_limits<std::size_t>::max());
    coarser.tolerance_ = tolerance_ * 2;
    for (const Knot& knot : knots_) {
        if (!knot.joined) {
            coarser.end_line();
            coarser.joined_ = false;
        }
        coarser.point(knot.tick, knot.position_steps);
    }
    coarser.end_line();
    knots_ = std::move(coarser.knots_);
    tolerance_ = coarser.tolerance_;
    error_ += tolerance_;
}

}  // namespace lockstep::analysis
