// A queue of an axis's measured steps. It does not copy them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "clients/analysis/measure/measured_step.hpp"

namespace lockstep::analysis {

class StepQueue {
public:
    void add(SharedSteps steps) {
        size_ += steps->edges.size();
        batches_.push_back(std::move(steps));
        if (batches_.size() == 1) { begin_batch(); }
    }
    bool empty() const { return ready_.empty(); }
    std::size_t size() const { return size_; }

    /// The first step, its tick, and the uncertainty of its time. The queue must not be empty.
    MeasuredStep front() const {
        const StepEdge next = ready_.front();
        return {next.tick, count_ + next.direction, next.direction, *rates_};
    }
    Tick tick() const { return ready_.tick(0); }
    Ticks clock_error() const { return batches_.front()->clock_error; }
    void pop() { pop(1, count_ + ready_.direction(0)); }

    /// The first steps, as many as came together; empty if the queue is. They are a part of batch().
    const StepSpan& ready() const { return ready_; }
    const StepEdges& batch() const { return batches_.front()->edges; }
    /// The rates of the ready steps.
    const StepRates* rates() const { return rates_; }
    /// The position before the first step.
    std::int64_t count() const { return count_; }
    /// Drops some of the ready steps, after which the position is `count`.
    void pop(std::size_t steps, std::int64_t count) {
        count_ = count;
        size_ -= steps;
        rates_ += steps;
        ready_ = ready_.subspan(steps);
        if (steps > 0 && ready_.empty()) { end_batch(); }
    }

private:
    void begin_batch() {
        const MeasuredSteps& first = *batches_.front();
        ready_ = first.edges;
        rates_ = first.rates.data();
        count_ = first.position_before;
    }
    void end_batch() {
        batches_.pop_front();
        if (!batches_.empty()) { begin_batch(); }
    }

    std::deque<SharedSteps> batches_;
    StepSpan ready_;                    // of the first batch
    const StepRates* rates_ = nullptr;  // of ready_
    std::int64_t count_ = 0;            // before ready_
    std::size_t size_ = 0;
};

}  // namespace lockstep::analysis
