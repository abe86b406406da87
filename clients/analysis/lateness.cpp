#include "clients/analysis/lateness.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace lockstep::analysis {

void Lateness::on_batch(const StepBatch& batch) {
    std::int64_t count = batch.position_before_steps;
    for (const StepEdge& step : batch.steps) { seen_.push_back({step, count += step.direction, batch.clock_error}); }
    last_tick_ = batch.steps.back().tick;
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
    const auto is_over = [&](const Run& run) {
        return last_tick_ && *last_tick_ - (run.commanded_start() + run.ticks()) > kPatience;
    };
    while (runs_.size() > kMaxWaiting || (!runs_.empty() && is_over(runs_.front()))) { compare_first(); }
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
        return next != nullptr && seen.edge.direction == next->direction &&
               seen.count == maker.count() + next->direction &&
               std::abs((seen.edge.tick - maker.commanded()).value) < kPatience.value;
    };
    while (!seen_.empty() && seen_.front().edge.tick < maker.run().commanded_start() && !is_next(seen_.front())) {
        seen_.pop_front();  // of runs that are not in the log
    }
    for (; !seen_.empty() && is_next(seen_.front()); seen_.pop_front(), maker.pass()) {
        const Tick commanded = maker.commanded();
        const SeenStep& seen = seen_.front();
        steps.push_back({.commanded = commanded,
                         .late = seen.edge.tick - commanded,
                         .error = seen.clock_error,
                         .count = seen.count,
                         .direction = seen.edge.direction});
    }
    return steps;
}

}  // namespace lockstep::analysis
