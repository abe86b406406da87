// The steps of an axis that wait for the record of their run, as batches; no step is copied.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "clients/verification/steps/seen_step.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::verification {

using analysis::StepSpan;

/// A batch of steps from the log, and how many of them were passed.
class SeenBatch {
public:
    explicit SeenBatch(analysis::StepBatch batch)
        : batch_(std::move(batch)), time_(batch_.machine_time()), count_(batch_.position_before_steps) {}

    bool empty() const { return passed_ == batch_.steps.size(); }
    std::size_t size() const { return batch_.steps.size() - passed_; }
    std::int64_t incarnation() const { return batch_.incarnation; }
    Ticks clock_error() const { return batch_.clock_error; }
    /// Whether device time is machine time in this batch.
    bool shares_time() const { return batch_.ahead_first == Ticks{} && batch_.ahead_last == Ticks{}; }
    /// The steps that were not passed, in device time.
    StepSpan edges() const { return batch_.steps.subspan(passed_); }
    Tick machine_time(Tick device) const { return time_.at(device); }
    /// The position before them.
    std::int64_t count() const { return count_; }
    SeenStep front() const {
        const StepEdge edge = batch_.steps[passed_];
        return {edge, count_ + edge.direction, batch_.incarnation, time_.at(edge.tick), batch_.clock_error};
    }
    /// The position after the next `steps` of them.
    std::int64_t count_after(std::size_t steps) const { return count_ + edges().first(steps).change(); }
    void pass(std::size_t steps) {
        count_ = count_after(steps);
        passed_ += steps;
    }

private:
    analysis::StepBatch batch_;
    ClockStretch time_;
    std::size_t passed_ = 0;
    std::int64_t count_;
};

class WaitingSteps {
public:
    /// The batch must have steps.
    void add(analysis::StepBatch batch) {
        size_ += batch.steps.size();
        batches_.emplace_back(std::move(batch));
    }
    bool empty() const { return batches_.empty(); }
    std::size_t size() const { return size_; }
    /// The next batch, which is never empty. There must be a step.
    const SeenBatch& batch() const { return batches_.front(); }
    SeenStep front() const { return batches_.front().front(); }
    /// Passes steps of the next batch.
    void pass(std::size_t steps) {
        batches_.front().pass(steps);
        size_ -= steps;
        if (batches_.front().empty()) { batches_.pop_front(); }
    }
    /// Drops the steps of a process before a tick of its device. Returns how many there were.
    std::int64_t drop_before(std::int64_t incarnation, Tick tick) {
        const std::size_t all = size_;
        for (SeenBatch& batch : batches_) {
            if (batch.incarnation() != incarnation) { continue; }
            const std::size_t before = batch.edges().before(tick);
            batch.pass(before);
            size_ -= before;
        }
        std::erase_if(batches_, [](const SeenBatch& batch) { return batch.empty(); });
        return static_cast<std::int64_t>(all - size_);
    }

private:
    std::deque<SeenBatch> batches_;
    std::size_t size_ = 0;
};

}  // namespace lockstep::verification
