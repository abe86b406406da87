#include "clients/verification/positions/position_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <utility>

namespace lockstep::verification {

void PositionCheck::take(const analysis::RecordedPosition& position) {
    if (last_ && position.tick < last_->tick) { return wait(position); }
    if (last_ && zero_.differs_between(*last_, position)) { zero_since_ = position.tick; }
    last_ = position;
    wait(position);
}

/// Positions may overtake each other in the log.
void PositionCheck::wait(const analysis::RecordedPosition& position) {
    const bool is_known = newest_ && position.steps == newest_->count && waiting_.empty();
    if (is_known || waiting_.size() == kMaxWaiting || (compared_ && position.tick < *compared_)) { return; }
    waiting_.insert(std::ranges::upper_bound(waiting_, position.tick, {}, &analysis::RecordedPosition::tick), position);
}

void PositionCheck::skip() {
    recent_.clear();
    stand_.reset();
    newest_.reset();
}

std::optional<std::string> PositionCheck::take(const analysis::StepBatch& batch, Ticks slot) {
    const ClockStretch time = batch.machine_time();
    const Tick last = time.at(batch.steps.back().tick);
    const Ticks reach = slot + batch.clock_error;
    newest_ = Stand{last, batch.position_before_steps + batch.steps.change()};
    recent_.push_back({batch, time, 0, batch.position_before_steps});
    std::optional<std::string> wrong;
    for (; !waiting_.empty() && waiting_.front().tick + reach <= last; waiting_.pop_front()) {
        compared_ = waiting_.front().tick;
        pass_before(*compared_ - reach);
        if (!wrong) { wrong = compare(waiting_.front(), reach); }
    }
    if (waiting_.empty()) { pass_before(last - reach * 2); }
    return wrong;
}

bool PositionCheck::Recent::pass_before(Tick tick) {
    const analysis::StepSpan left = batch.steps.subspan(passed);
    const auto is_before = [&](std::size_t step) { return time.at(left.tick(step)) < tick; };
    const std::size_t now = *std::ranges::partition_point(std::views::iota(std::size_t{0}, left.size()), is_before);
    count += left.first(now).change();
    passed += now;
    return now > 0;
}

/// Passes the steps before a time.
void PositionCheck::pass_before(Tick tick) {
    while (!recent_.empty()) {
        Recent& first = recent_.front();
        if (first.pass_before(tick)) { stand_ = Stand{first.last(), first.count}; }
        if (!first.is_passed()) { return; }
        recent_.pop_front();
    }
}

/// Where positions count from another zero between two steps, both zeros are possible.
std::optional<std::string> PositionCheck::compare(const analysis::RecordedPosition& position, Ticks reach) const {
    if (!stand_ || recent_.empty() || (zero_since_ && position.tick <= *zero_since_ + reach)) { return std::nullopt; }
    Range allowed{stand_->count, stand_->count};
    for (const Recent& of : recent_) {
        std::int64_t count = of.count;
        allowed.add(count);
        for (std::size_t i = of.passed; i < of.batch.steps.size(); ++i) {
            if (of.time.at(of.batch.steps.tick(i)) > position.tick + reach) { break; }
            count += of.batch.steps.direction(i);
            allowed.add(count);
        }
    }
    if (allowed.low <= position.steps && position.steps <= allowed.high) { return std::nullopt; }
    return text(position, allowed);
}

std::string PositionCheck::text(const analysis::RecordedPosition& position, const Range& allowed) {
    return fmt::format("its position at tick {} is recorded as {}, but by its steps it is between {} and {}",
                       position.tick.value, position.steps, allowed.low, allowed.high);
}

std::optional<std::string> PositionCheck::finish() {
    const bool is_known = newest_ && (!zero_since_ || *zero_since_ <= newest_->from);
    for (const analysis::RecordedPosition& position : waiting_) {
        if (!is_known || position.tick <= newest_->from || position.steps == newest_->count) { continue; }
        return text(position, {newest_->count, newest_->count});
    }
    return std::nullopt;
}

}  // namespace lockstep::verification
