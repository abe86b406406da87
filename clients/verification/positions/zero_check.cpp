#include "clients/verification/positions/zero_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::verification {
namespace {

constexpr const char* kMissing = "the log lacks messages that may tell why";

}  // namespace

// ---- Positions -----------------------------------------------------------------------------------------------------

void ZeroCheck::take(const analysis::RecordedPosition& position) {
    processes_.take(position.incarnation);
    if (incarnation_ && processes_.is_older(position.incarnation, *incarnation_)) { return; }
    if (incarnation_ != position.incarnation) {
        deliver(0);
        incarnation_ = position.incarnation;
        expected_ = 0;
    }
    if (position.sequence < expected_) { return; }
    waiting_.emplace(position.sequence, position);
    deliver(kPatience);
}

void ZeroCheck::deliver(std::size_t patience) {
    while (!waiting_.empty() && (waiting_.begin()->first == expected_ || waiting_.size() > patience)) {
        const analysis::RecordedPosition position = waiting_.extract(waiting_.begin()).mapped();
        pass(position);
        expected_ = position.sequence + 1;
        last_ = position;
        settle(false);
    }
}

void ZeroCheck::pass(const analysis::RecordedPosition& position) {
    if (!last_) { return void(known_from_ = position.tick); }
    const Span since{last_->tick, position.tick};
    if (!position.is_next_after(*last_)) { add(std::nullopt, since); }
    if (const auto move = zero_.move_between(*last_, position)) { add(move, since); }
}

void ZeroCheck::add(std::optional<analysis::ZeroMove> move, Span span) {
    reasons_.push_back({move, span});
    if (reasons_.size() <= kMaxReasons) { return; }
    known_from_ = reasons_.front().span.to;
    reasons_.pop_front();
}

// ---- Runs ----------------------------------------------------------------------------------------------------------

void ZeroCheck::take(const analysis::Run& before, const analysis::Run& run,
                     const std::function<std::string()>& commanded) {
    const Span span{before.commanded_start(), run.commanded_start()};
    if (before.zero_count != run.zero_count) {
        changes_.push_back({.span = span,
                            .change = run.zero_count - before.zero_count,
                            .text = fmt::format("{} counts from {} of its device, but the run before it from {}",
                                                name_of(run), run.zero_count, before.zero_count),
                            .commanded = commanded(),
                            .why_unknown = {},
                            .homed_in_place = {}});
        return settle(false);
    }
    const Tick needed = changes_.empty() ? span.from : changes_.front().span.from;
    while (!reasons_.empty() && reasons_.front().span.to < needed) { reasons_.pop_front(); }
}

void ZeroCheck::settle(bool log_ended) {
    while (!changes_.empty() && (log_ended || (last_ && last_->tick > changes_.front().span.to))) {
        Change change = std::move(changes_.front());
        changes_.pop_front();
        if (!is_told(change)) { untold_.push_back(std::move(change)); }
    }
}

/// Whether the positions tell why the zero has moved.
bool ZeroCheck::is_told(Change& change) const {
    const bool is_known = known_from_ && *known_from_ <= change.span.from && last_->tick >= change.span.to;
    if (!is_known) { change.why_unknown = kMissing; }
    for (const Reason& reason : reasons_) {
        if (!reason.span.meets(change.span)) { continue; }
        using Why = analysis::ZeroMove::Why;
        if (!reason.move || reason.move->why == Why::OtherProcess) {
            change.why_unknown = kMissing;
            continue;
        }
        const bool fits = reason.move->change == change.change;
        const bool is_correction = reason.move->why == Why::LostSteps;
        if (reason.move->why == Why::NotHomed || (is_correction && fits)) { return true; }
        if (fits) { change.homed_in_place = reason.span; }
        if (is_correction && change.why_unknown.empty()) {
            change.why_unknown = fmt::format("the positions show a correction by {:+}", reason.move->change);
        }
    }
    return false;
}

std::vector<ZeroCheck::Change> ZeroCheck::finish(const HomingJobs& homings, bool lacks_jobs) {
    deliver(0);
    settle(true);
    const auto us = [&](Tick tick) { return utime_of(tick, tick_ns_.value_or(1000)); };
    std::erase_if(untold_, [&](const Change& change) {
        const auto& homed = change.homed_in_place;
        return homed && homings.any_in(us(homed->from), us(homed->to));
    });
    for (Change& change : untold_) {
        if (!tick_ns_ || (change.homed_in_place && lacks_jobs)) { change.why_unknown = kMissing; }
    }
    return std::move(untold_);
}

}  // namespace lockstep::verification
