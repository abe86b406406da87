#include "clients/verification/position_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace lockstep::verification {

void PositionCheck::take(const SeenPosition& position) {
    const bool is_new_zero =
        newest_ && (position.incarnation != newest_->incarnation || position.is_homed != newest_->is_homed);
    if (is_new_zero) { anew_ = position.tick; }
    newest_ = position;
    const bool is_known = stretch_ && position.steps == stretch_->count && waiting_.empty();
    if (is_known || waiting_.size() == kMaxWaiting) { return; }
    waiting_.push_back(position);
}

std::optional<std::string> PositionCheck::compare(const SeenPosition& position, const Range& allowed) const {
    if (allowed.low <= position.steps && position.steps <= allowed.high) { return std::nullopt; }
    return fmt::format("axis {}: its position at tick {} is recorded as {}, but by its steps it is between {} and {}",
                       axis_, position.tick.value, position.steps, allowed.low, allowed.high);
}

std::optional<std::string> PositionCheck::take(const analysis::StepBatch& batch, Ticks slot) {
    const ClockStretch time = batch.machine_time();
    const Ticks reach = slot + batch.clock_error;
    const std::optional<Stretch> before = stretch_;
    const Tick last = time.at(batch.steps.back().tick);
    std::int64_t count = batch.position_before_steps;
    for (const StepEdge& step : batch.steps) { count += step.direction; }
    stretch_ = Stretch{last, count};
    std::optional<std::string> wrong;
    std::size_t first = 0;  // of the steps that may be before the position
    std::int64_t passed = batch.position_before_steps;
    while (!waiting_.empty() && waiting_.front().tick + reach <= last) {
        const SeenPosition position = waiting_.front();
        waiting_.pop_front();
        while (first < batch.steps.size() && time.at(batch.steps[first].tick) < position.tick - reach) {
            passed += batch.steps[first++].direction;
        }
        const bool is_covered = first > 0 || (before && before->from < position.tick - reach);
        if (!is_covered || (anew_ && position.tick <= *anew_)) { continue; }
        Range allowed{passed, passed};
        if (first == 0 && before) { allowed.add(before->count); }
        std::int64_t at = passed;
        for (std::size_t i = first; i < batch.steps.size() && time.at(batch.steps[i].tick) <= position.tick + reach;
             ++i) {
            at += batch.steps[i].direction;
            allowed.add(at);
        }
        if (!wrong) { wrong = compare(position, allowed); }
    }
    return wrong;
}

std::optional<std::string> PositionCheck::finish() {
    std::optional<std::string> wrong;
    for (const SeenPosition& position : waiting_) {
        const bool is_after = stretch_ && position.tick > stretch_->from && (!anew_ || *anew_ <= stretch_->from);
        if (is_after && !wrong) { wrong = compare(position, {stretch_->count, stretch_->count}); }
    }
    return wrong;
}

}  // namespace lockstep::verification
