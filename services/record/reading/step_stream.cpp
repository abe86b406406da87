#include "services/record/reading/step_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/number_text.hpp"

namespace lockstep::analysis {
namespace {

constexpr std::size_t kGivenUpKept = 64;

std::size_t content_of(const StepBatch& batch) {
    ContentHash hash;
    hash.add(batch.position_before_steps).add(batch.ahead_first.value).add(batch.ahead_last.value);
    return hash.add(static_cast<std::int64_t>(batch.steps.content())).value();
}

}  // namespace

ClockStretch StepBatch::machine_time() const {
    const Tick first = steps.front().tick;
    const Ticks ticks{std::max<std::int64_t>(1, (steps.back().tick - first).value)};
    return {first, ticks, first + ahead_first, ticks + ahead_last - ahead_first};
}

std::string sentence(const Contradiction& what) {
    const std::string which = fmt::format("message {} with {}", what.sequence, plural(what.steps, "step"));
    switch (what.kind) {
        case Contradiction::Kind::NotAfter:
            return fmt::format("{} begins at tick {}, but the message before it ends at tick {}", which,
                               what.first.value_or(Tick{}).value, what.last_before.value_or(Tick{}).value);
        case Contradiction::Kind::OtherContent: return which + " is in the log twice, with different content";
        case Contradiction::Kind::EndedProcess: return which + " is of a process that another one had replaced before";
    }
    return which;
}

void StepStream::take(StepBatch batch) {
    if (has_passed(batch)) { return; }
    if (incarnation_ != batch.incarnation) { begin_incarnation(batch.incarnation); }
    const std::int64_t sequence = batch.sequence;
    if (waiting_.contains(sequence)) { return note_repeat(batch); }
    contents_.add({batch.incarnation, sequence}, content_of(batch));
    waiting_.emplace(sequence, std::move(batch));
    deliver_in_order(true);
}

void StepStream::finish() {
    deliver_in_order(false);
    close_break(std::nullopt);
}

/// Whether the batch comes after its turn; if it does, counts it as late or as a duplicate.
bool StepStream::has_passed(const StepBatch& batch) {
    if (past_incarnations_.contains(batch.incarnation)) {
        note_repeat(batch);
        return true;
    }
    if (incarnation_ != batch.incarnation || batch.sequence >= expected_) { return false; }
    const auto holds = [&](Numbers range) { return range.from <= batch.sequence && batch.sequence < range.end; };
    const bool given_up = std::ranges::any_of(given_up_, holds) || batch.sequence < kFirstSequence;
    given_up ? void(++counts_.late) : note_repeat(batch);
    return true;
}

/// A repeat must have the content of the first one, as far as that is remembered.
void StepStream::note_repeat(const StepBatch& batch) {
    const auto content = contents_.find({batch.incarnation, batch.sequence});
    if (content && *content != content_of(batch)) { return contradict(Contradiction::Kind::OtherContent, batch); }
    const bool is_of_ended = past_incarnations_.contains(batch.incarnation);
    if (!content && is_of_ended) { return contradict(Contradiction::Kind::EndedProcess, batch); }
    ++counts_.duplicates;
}

void StepStream::contradict(Contradiction::Kind kind, const StepBatch& batch) {
    ++counts_.contradictory;
    Contradiction what{.kind = kind,
                       .sequence = batch.sequence,
                       .steps = std::ssize(batch.steps),
                       .first = {},
                       .last_before = last_tick_};
    if (!batch.steps.empty()) { what.first = batch.steps.front().tick; }
    for (StepListener* listener : listeners_) { listener->on_contradiction(what); }
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
        return contradict(Contradiction::Kind::NotAfter, batch);
    }
    note_position(batch.position_before_steps);
    ++counts_.batches;
    if (batch.steps.empty()) { return; }
    close_break(batch.steps.front().tick);
    for (StepListener* listener : listeners_) { listener->on_batch(batch); }
    *position_ += batch.steps.change();
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
