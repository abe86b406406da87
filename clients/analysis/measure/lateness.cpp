#include "clients/analysis/measure/lateness.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace lockstep::analysis {
namespace {

/// The number of steps of a run that does not reverse.
std::size_t likely_steps(const Run& run) {
    return static_cast<std::size_t>(std::abs(run.to().count() - run.from.count()));
}

}  // namespace

void Lateness::take(SharedSteps steps) {
    last_tick_ = std::max(last_tick_.value_or(steps->steps.back().tick), steps->steps.back().tick);
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

/// Compares the run's steps up to the first one that is not in the log.
LateRun Lateness::compare(StepMaker maker) {
    LateRun run;
    std::vector<LateStep>& steps = run.steps;
    const auto is_next = [&](const MeasuredStep& seen) {
        const StepEdge* next = maker.next();
        return next != nullptr && seen.direction == next->direction && seen.count == maker.count() + next->direction &&
               std::abs((seen.tick - maker.commanded()).value) < kPatience.value;
    };
    while (!seen_.empty() && seen_.front().tick < maker.run().commanded_start() && !is_next(seen_.front())) {
        seen_.pop();  // steps of runs that are not in the log
    }
    steps.reserve(std::min(seen_.size(), likely_steps(maker.run())));
    for (; !seen_.empty() && is_next(seen_.front()); seen_.pop(), maker.pass()) {
        const MeasuredStep& seen = seen_.front();
        LateStep& step = steps.emplace_back();
        step.commanded = maker.commanded();
        step.late = seen.tick - step.commanded;
        run.are_equally_late = run.are_equally_late && step.late == steps.front().late;
        step.error = seen_.clock_error();
        step.count = seen.count;
        step.direction = seen.direction;
    }
    return run;
}

}  // namespace lockstep::analysis
