// A queue of an axis's measured steps. It does not copy them.
#pragma once

#include <cstddef>
#include <deque>
#include <utility>

#include "clients/analysis/measure/measured_step.hpp"

namespace lockstep::analysis {

class StepQueue {
public:
    void add(SharedSteps steps) {
        size_ += steps->steps.size();
        batches_.push_back(std::move(steps));
        if (batches_.size() == 1) { begin_batch(); }
    }
    bool empty() const { return next_ == end_; }
    std::size_t size() const { return size_; }

    /// The first step, and the uncertainty of its time. The queue must not be empty.
    const MeasuredStep& front() const { return *next_; }
    Ticks clock_error() const { return batches_.front()->clock_error; }
    void pop() {
        --size_;
        if (++next_ == end_) { end_batch(); }
    }

private:
    void begin_batch() {
        next_ = batches_.front()->steps.data();
        end_ = next_ + batches_.front()->steps.size();
    }
    void end_batch() {
        batches_.pop_front();
        next_ = end_ = nullptr;
        if (!batches_.empty()) { begin_batch(); }
    }

    std::deque<SharedSteps> batches_;
    const MeasuredStep* next_ = nullptr;  // in the first batch
    const MeasuredStep* end_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace lockstep::analysis
