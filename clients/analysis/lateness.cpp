#include "clients/analysis/lateness.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace lockstep::analysis {
namespace {

/// As many steps as a run makes where it does not turn back.
std::ptrdiff_t likely_steps(const Run& run) { return std::abs(run.to().count() - run.from.count()); }

}  // namespace

void Lateness::take(std::span<const MeasuredStep> steps, Ticks clock_error) {
    if (compared_ * 2 > seen_.size()) {
        seen_.erase(seen_.begin(), seen_.begin() + static_cast<std::ptrdiff_t>(std::exchange(compared_, 0)));
    }
    for (const MeasuredStep& step : steps) {
        SeenStep& seen = seen_.emplace_back();
        seen.tick = step.tick;
        seen.count = step.count;
        seen.clock_error = clock_error;
        seen.direction = step.direction;
    }
    last_tick_ = steps.back().tick;
    settle();
}

void Lateness::take(Run run) {
    const auto later = std::ranges::upper_bound(runs_, run.commanded_start(), {}, &Run::commanded_start);
    runs_.insert(later, std::move(run));
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

/// The first run lasts no longer than until the next begins: it may have been cut.
Tick Lateness::first_end() const {
    const Tick end = runs_.front().commanded_start() + runs_.front().ticks();
    return runs_.size() > 1 ? std::min(end, runs_[1].commanded_start()) : end;
}

void Lateness::compare_first() {
    const Run run = std::move(runs_.front());
    runs_.pop_front();
    auto steps = compare(StepMaker(run));
    if (run.epoch != 0) { on_run_(run, std::move(steps)); }
}

/// Up to the first that is not in the log.
std::vector<LateStep> Lateness::compare(StepMaker maker) {
    std::vector<LateStep> steps;
    const auto is_next = [&](const SeenStep& seen) {
        const StepEdge* next = maker.next();
        return next != nullptr && seen.direction == next->direction && seen.count == maker.count() + next->direction &&
               std::abs((seen.tick - maker.commanded()).value) < kPatience.value;
    };
    auto seen = seen_.begin() + static_cast<std::ptrdiff_t>(compared_);
    while (seen != seen_.end() && seen->tick < maker.run().commanded_start() && !is_next(*seen)) {
        ++seen;  // of runs that are not in the log
    }
    steps.reserve(static_cast<std::size_t>(std::min<std::ptrdiff_t>(seen_.end() - seen, likely_steps(maker.run()))));
    for (; seen != seen_.end() && is_next(*seen); ++seen, maker.pass()) {
        LateStep& step = steps.emplace_back();
        step.commanded = maker.commanded();
        step.late = seen->tick - step.commanded;
        step.error = seen->clock_error;
        step.count = seen->count;
        step.direction = seen->direction;
    }
    compared_ = static_cast<std::size_t>(seen - seen_.begin());
    return steps;
}

}  // namespace lockstep::analysis
