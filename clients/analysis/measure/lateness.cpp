#include "clients/analysis/measure/lateness.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace lockstep::analysis {

EquallyLate EquallyLate::first(std::size_t count) const {
    const StepSpan part = steps.first(count);
    return {part, before, part.change(), late, error};
}

EquallyLate EquallyLate::behind(std::size_t count) const {
    const std::int64_t passed = first(count).change;
    return {steps.subspan(count), before + passed, change - passed, late, error};
}

void Lateness::take(SharedSteps steps) {
    const Tick newest = steps->edges.back().tick;
    last_tick_ = std::max(last_tick_.value_or(newest), newest);
    seen_.add(std::move(steps));
    settle();
    while (seen_.size() > kMaxSeen) { seen_.pop(); }
}

void Lateness::take(Run run) {
    const auto later = std::ranges::upper_bound(runs_, run.commanded_start(), {}, &Run::commanded_start);
    runs_.insert(later, std::move(run));
    settle();
}

/// Steps are published up to 10 ms after they are made, but a process or its messages may be late.
void Lateness::pass(Tick tick) {
    constexpr Ticks kLatest{3'000'000};
    const Tick known = tick - kLatest;
    if (last_tick_ && known <= *last_tick_) { return; }
    last_tick_ = known;
    settle();
}

void Lateness::finish() {
    while (!runs_.empty()) { compare_first(); }
}

void Lateness::settle() {
    while (runs_.size() > kMaxWaiting || (!runs_.empty() && last_tick_ && *last_tick_ - first_end() > kPatience)) {
        compare_first();
    }
}

/// The first run lasts at most until the next one begins, because it may have been cut.
Tick Lateness::first_end() const {
    const Tick end = runs_.front().commanded_start() + runs_.front().ticks();
    return runs_.size() > 1 ? std::min(end, runs_[1].commanded_start()) : end;
}

void Lateness::compare_first() {
    const Run run = std::move(runs_.front());
    runs_.pop_front();
    auto late = std::make_shared<const LateRun>(compare(StepMaker(run)));
    if (run.epoch != 0) { on_run_(run, std::move(late)); }
}

/// Whether the first step in the log is the next step of the run.
bool Lateness::is_next(StepMaker& maker) const {
    const StepEdge* next = maker.next();
    const MeasuredStep seen = seen_.front();
    return next != nullptr && seen.direction == next->direction && seen.count == maker.count() + next->direction &&
           std::abs((seen.tick - maker.commanded()).value) < kPatience.value;
}

/// Compares the run's steps up to the first one that is not in the log.
LateRun Lateness::compare(StepMaker maker) {
    while (!seen_.empty() && seen_.tick() < maker.run().commanded_start() && !is_next(maker)) {
        seen_.pop();  // steps of runs that are not in the log
    }
    LateRun run;
    while (compare_ready(maker, run)) {}
    return run;
}

/// The number of steps from the first on that are as late.
std::size_t Lateness::equally_late(const StepMaker& maker, const StepSpan& seen, const StepSpan& made, Ticks late) {
    if (const auto ahead = maker.ahead_of_commanded()) { return equal_steps(seen, made, late - *ahead); }
    const auto is_as_late = [&](std::size_t i) {
        return seen.direction(i) == made.direction(i) && seen.tick(i) - maker.commanded_at(made.tick(i)) == late;
    };
    std::size_t equal = 0;
    while (equal < std::min(seen.size(), made.size()) && is_as_late(equal)) { ++equal; }
    return equal;
}

/// Compares the steps of one message with those that are made at once. Returns false behind the last equal step.
bool Lateness::compare_ready(StepMaker& maker, LateRun& run) {
    if (seen_.empty() || !is_next(maker)) { return false; }
    const StepSpan made = maker.ready();
    const StepSpan seen = seen_.ready();
    const std::size_t most = std::min(made.size(), seen.size());
    run.messages.push_back(seen_.batch());
    std::int64_t count = maker.count();
    std::size_t equal = 0;
    while (equal < most) {
        const Ticks late = seen.tick(equal) - maker.commanded_at(made.tick(equal));
        if (std::abs(late.value) >= kPatience.value) { break; }
        const std::size_t from = equal;
        const std::int64_t before = count;
        equal += equally_late(maker, seen.subspan(from), made.subspan(from), late);
        if (equal == from) { break; }
        count += made.subspan(from, equal - from).change();
        run.groups.push_back({seen.subspan(from, equal - from), before, count - before, late, seen_.clock_error()});
    }
    maker.pass(equal, count);
    seen_.pop(equal, count);
    return equal == most;
}

}  // namespace lockstep::analysis
