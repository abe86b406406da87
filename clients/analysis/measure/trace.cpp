#include "clients/analysis/measure/trace.hpp"

#include "clients/analysis/vector/clones.hpp"
#include "clients/analysis/vector/lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace lockstep::analysis {
namespace {

// An interval this many times longer than the previous one contains a rest.
constexpr std::int32_t kRestRatio = 4;

// Whole numbers to which any tick of a message can be added without rounding.
constexpr double kExact = 1LL << 52;

double ticks_between(Tick from, Tick to) { return static_cast<double>(to.value - from.value); }

}  // namespace

void Trace::on_batch(const StepBatch& batch) {
    position_ = batch.position_before_steps;
    for (std::size_t i = 0; i < batch.steps.size();) {
        const StepSpan steps = batch.steps.subspan(i, std::min(kBlock, batch.steps.size() - i));
        i += steps.size();
        if (steps.size() == kBlock && block(steps)) { continue; }
        for (const StepEdge& step : steps) {
            this->step(step, position_);
            position_ += step.direction;
        }
    }
}

/// Takes kBlock steps as step() does, but all at once, which costs less. Returns false and takes none if the current
/// line might not pass all of them, or if the axis might have rested or turned.
LOCKSTEP_VECTOR_CLONES
bool Trace::block(const StepSpan& steps) {
    if (!newest_ || !last_step_ || last_interval_ == Ticks{} || !goes_on(steps)) { return false; }
    const Knot& anchor = knots_.back();
    const std::int64_t direction = steps.direction(0);
    const double first = static_cast<double>(position_) + static_cast<double>(direction) * 0.5 - anchor.position_steps;
    const double since = ticks_between(anchor.tick, steps.origin());
    if (std::abs(since) > kExact) { return false; }
    const std::int32_t* const ticks = steps.ticks();
    std::array<double, kBlock> slopes;
    std::array<double, kBlock> lows;
    std::array<double, kBlock> highs;
    for (std::size_t i = 0; i < kBlock; ++i) {
        const double time = since + ticks[i];
        const double half_angle = tolerance_ / time;
        slopes[i] = (first + static_cast<double>(static_cast<std::int32_t>(i)) * static_cast<double>(direction)) / time;
        lows[i] = slopes[i] - half_angle;
        highs[i] = slopes[i] + half_angle;
    }
    const double low = std::max(low_slope_, highest_of(lows));
    const double high = std::min(high_slope_, lowest_of(highs));
    if (lowest_of(slopes) < low || highest_of(slopes) > high) { return false; }
    low_slope_ = low;
    high_slope_ = high;
    position_ += direction * static_cast<std::int64_t>(kBlock);
    last_step_ = steps.tick(kBlock - 1);
    last_interval_ = Ticks{ticks[kBlock - 1] - ticks[kBlock - 2]};
    newest_ = Knot{*last_step_, static_cast<double>(position_ - direction) + static_cast<double>(direction) * 0.5};
    return true;
}

/// Whether the axis goes on in one direction, without a rest.
LOCKSTEP_VECTOR_CLONES
bool Trace::goes_on(const StepSpan& steps) const {
    constexpr std::int64_t kShort = 1 << 28;  // an interval that can be multiplied
    const Ticks first = steps.tick(0) - *last_step_;
    if (std::max(first, last_interval_).value > kShort || steps.one_way() < kBlock) { return false; }
    const std::int32_t* const ticks = steps.ticks();
    if (ticks[kBlock - 1] - ticks[0] > kShort) { return false; }
    std::array<std::int32_t, kBlock + 1> intervals;
    intervals[0] = static_cast<std::int32_t>(last_interval_.value);
    intervals[1] = static_cast<std::int32_t>(first.value);
    for (std::size_t i = 1; i < kBlock; ++i) { intervals[i + 1] = ticks[i] - ticks[i - 1]; }
    std::int32_t rests = 0;
    for (std::size_t i = 0; i < kBlock; ++i) { rests |= intervals[i + 1] >= intervals[i] * kRestRatio ? 1 : 0; }
    return rests == 0;
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
