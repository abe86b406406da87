#include "clients/verification/positions/zero_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::verification {
namespace {

constexpr const char* kMissing = "the log lacks messages that may tell why";

}  // namespace

void ZeroCheck::set_machine(const MachineConfig& machine, const std::string& name) {
    tick_ns_ = machine.tick_ns;
    const auto motor = motor_named(machine, name);
    homes_in_place_ = motor && !row_of(motors_of(machine)[*motor].homing.way).searches;
}

// ---- Positions -----------------------------------------------------------------------------------------------------

void ZeroCheck::take(const SeenPosition& position) {
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
        const SeenPosition position = waiting_.extract(waiting_.begin()).mapped();
        pass(position);
        expected_ = position.sequence + 1;
        last_ = position;
        settle(false);
    }
}

/// A process that has ended may have left its last positions unrecorded.
void ZeroCheck::pass(const SeenPosition& position) {
    if (!last_) { known_from_ = position.tick; }
    const Span since{last_ ? last_->tick : position.tick, position.tick};
    const bool follows = last_ && last_->incarnation == position.incarnation;
    const bool is_next = follows && last_->sequence + 1 == position.sequence;
    if (last_ && !is_next) { add(Reason::Kind::Missing, since); }
    if (!position.is_homed || (last_ && !last_->is_homed)) { return add(Reason::Kind::NotHomed, since); }
    if (follows && last_->following_error != 0 && last_->following_error != position.following_error) {
        add(Reason::Kind::Corrected, since, -last_->following_error);
    }
}

void ZeroCheck::add(Reason::Kind kind, Span span, std::int64_t change) {
    const bool goes_on = !reasons_.empty() && reasons_.back().kind == kind && kind == Reason::Kind::NotHomed &&
                         reasons_.back().span.to == span.from;
    if (goes_on) { return void(reasons_.back().span.to = span.to); }
    reasons_.push_back({kind, span, change});
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
                            .why_unknown = {}});
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
        const bool is_correction = reason.kind == Reason::Kind::Corrected;
        if (reason.kind == Reason::Kind::NotHomed || (is_correction && reason.change == change.change)) { return true; }
        if (!is_correction) { change.why_unknown = kMissing; }
        if (change.why_unknown.empty()) {
            change.why_unknown = fmt::format("the positions show a correction by {:+}", reason.change);
        }
    }
    return false;
}

std::vector<ZeroCheck::Change> ZeroCheck::finish(const HomingJobs& homings, bool lacks_jobs) {
    deliver(0);
    settle(true);
    const auto us = [&](Tick tick) { return utime_of(tick, tick_ns_.value_or(1000)); };
    std::erase_if(untold_, [&](const Change& change) {
        return homes_in_place_ && homings.any_in(us(change.span.from), us(change.span.to));
    });
    for (Change& change : untold_) {
        if (!tick_ns_ || (homes_in_place_ && lacks_jobs)) { change.why_unknown = kMissing; }
    }
    return std::move(untold_);
}

}  // namespace lockstep::verification
