// A queue of an axis's measured steps. It does not copy them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
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
    bool empty() const { return next_ == end_; }
    std::size_t size() const { return size_; }

    /// The first step, its tick, and the uncertainty of its time. The queue must not be empty.
    MeasuredStep front() const { return {next_->tick, count_ + next_->direction, next_->direction, *rates_}; }
    Tick tick() const { return next_->tick; }
    Ticks clock_error() const { return batches_.front()->clock_error; }
    void pop() {
        count_ += next_->direction;
        go_to(next_ + 1);
    }

    /// The first steps, as many as came together; empty if the queue is. They are a part of batch().
    std::span<const StepEdge> ready() const { return {next_, end_}; }
    const StepEdges& batch() const { return batches_.front()->edges; }
    /// The rates of the ready steps.
    const StepRates* rates() const { return rates_; }
    /// The position before the first step.
    std::int64_t count() const { return count_; }
    /// Drops some of the ready steps, after which the position is `count`.
    void pop(std::size_t steps, std::int64_t count) {
        count_ = count;
        if (steps > 0) { go_to(next_ + steps); }
    }

private:
    void begin_batch() {
        const MeasuredSteps& first = *batches_.front();
        next_ = first.edges.begin();
        end_ = first.edges.end();
        rates_ = first.rates.data();
        count_ = first.position_before;
    }
    void go_to(const StepEdge* step) {
        size_ -= static_cast<std::size_t>(step - next_);
        rates_ += step - next_;
        next_ = step;
        if (next_ == end_) { end_batch(); }
    }
    void end_batch() {
        batches_.pop_front();
        next_ = end_ = nullptr;
        if (!batches_.empty()) { begin_batch(); }
    }

    std::deque<SharedSteps> batches_;
    const StepEdge* next_ = nullptr;  // in the first batch
    const StepEdge* end_ = nullptr;
    const StepRates* rates_ = nullptr;  // of next_
    std::int64_t count_ = 0;            // before next_
    std::size_t size_ = 0;
};

}  // namespace lockstep::analysis
