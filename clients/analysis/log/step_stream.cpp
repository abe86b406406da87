#include "clients/analysis/log/step_stream.hpp"

#include <algorithm>
#include <utility>

namespace lockstep::analysis {
namespace {

constexpr std::size_t kGivenUpKept = 64;

}  // namespace

ClockStretch StepBatch::machine_time() const {
    const Tick first = steps.front().tick;
    const Ticks ticks{std::max<std::int64_t>(1, (steps.back().tick - first).value)};
    return {first, ticks, first + ahead_first, ticks + ahead_last - ahead_first};
}

void StepStream::take(StepBatch batch) {
    if (has_passed(batch)) { return; }
    if (incarnation_ != batch.incarnation) { begin_incarnation(batch.incarnation); }
    const std::int64_t sequence = batch.sequence;
    if (!waiting_.emplace(sequence, std::move(batch)).second) { ++counts_.duplicates; }
    deliver_in_order(true);
}

void StepStream::finish() {
    deliver_in_order(false);
    close_break(std::nullopt);
}

/// Whether the batch comes after its turn; if it does, counts it as late or as a duplicate.
bool StepStream::has_passed(const StepBatch& batch) {
    if (past_incarnations_.contains(batch.incarnation)) {
        ++counts_.duplicates;
        return true;
    }
    if (incarnation_ != batch.incarnation || batch.sequence >= expected_) { return false; }
    const auto holds = [&](Numbers range) { return range.from <= batch.sequence && batch.sequence < range.end; };
    const bool given_up = std::ranges::any_of(given_up_, holds) || batch.sequence < kFirstSequence;
    ++(given_up ? counts_.late : counts_.duplicates);
    return true;
}

void StepStream::begin_incarnation(std::int64_t incarnation) {
    deliver_in_order(false);
    if (incarnation_) {
        past_incarnations_.insert(*incarnation_);
        open_break(Break::Kind::Restart);
    }
    incarnation_ = incarnation;
    expected_ = kFirstSequence;
    given_up_.clear();
}

void StepStream::deliver_in_order(bool wait) {
    while (!waiting_.empty()) {
        const bool is_next = waiting_.begin()->first == expected_;
        if (!is_next && wait && waiting_.size() <= kPatience) { return; }
        deliver(waiting_.extract(waiting_.begin()).mapped());
    }
}

void StepStream::deliver(const StepBatch& batch) {
    note_missing(batch.sequence);
    const bool restarted = break_ && break_->kind == Break::Kind::Restart;
    if (!batch.steps.empty() && last_tick_ && batch.steps.front().tick <= *last_tick_ && !restarted) {
        ++counts_.disordered;
        return;
    }
    note_position(batch.position_before_steps);
    ++counts_.batches;
    if (batch.steps.empty()) { return; }
    close_break(batch.steps.front().tick);
    for (StepListener* listener : listeners_) { listener->on_batch(batch); }
    for (const StepEdge& step : batch.steps) { *position_ += step.direction; }
    counts_.steps += static_cast<std::int64_t>(batch.steps.size());
    last_tick_ = batch.steps.back().tick;
}

void StepStream::note_missing(std::int64_t sequence) {
    if (sequence > expected_) {
        open_break(Break::Kind::Missing).missing_batches += sequence - expected_;
        given_up_.push_back({expected_, sequence});
        if (given_up_.size() > kGivenUpKept) { given_up_.pop_front(); }
    }
    expected_ = sequence + 1;
}

void StepStream::note_position(std::int64_t position_before) {
    if (position_ && *position_ != position_before) {
        open_break(Break::Kind::Jump).position_change += position_before - *position_;
    }
    position_ = position_before;
}

/// Returns the open break, or opens one of this kind.
Break& StepStream::open_break(Break::Kind kind) {
    if (!break_) { break_ = Break{.kind = kind, .from = last_tick_}; }
    return *break_;
}

void StepStream::close_break(std::optional<Tick> to) {
    if (!break_) { return; }
    break_->to = to;
    for (StepListener* listener : listeners_) { listener->on_break(*break_); }
    break_.reset();
}

}  // namespace lockstep::analysis
