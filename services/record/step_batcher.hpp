// Collects the steps of one axis into messages. It publishes one message each kBatchPeriod, and another one whenever a
// message is full. The axes publish at different times of the period, so that a logger does not receive all messages at
// once.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include <lockstep/step_batch_t.hpp>

#include "core/step/segment.hpp"

namespace lockstep {

class StepBatcher {
public:
    /// `batch` is complete except for its machine times.
    using Publish = std::function<void(step_batch_t& batch)>;

    static constexpr std::chrono::nanoseconds kBatchPeriod = std::chrono::milliseconds{10};
    static constexpr std::int32_t kMaxSteps = 2000;  // 10 KB: larger messages only need more fragments

    struct Source {
        std::string machine;
        std::string axis;
        std::uint32_t axis_index = 0;
        std::uint64_t incarnation = 0;  // of the axis's process
        std::int64_t tick_ns = 1000;
    };

    StepBatcher(Source source, std::int64_t position_steps, Publish publish);

    /// Call it in the order of the steps' ticks.
    void add(StepEdge step);

    /// Publishes the collected steps if it is the axis's turn. Call it once a loop, with the device's time. An axis at
    /// rest publishes nothing.
    void poll(Tick now);

    /// Publishes the collected steps.
    void flush();

    /// Sets the count without steps, because the axis was zeroed or the times of some steps were lost. Publishes the
    /// collected steps first, so that a reader sees the jump between two batches.
    void set_position(std::int64_t position_steps);

    std::int64_t position_steps() const { return batch_.position_before + moved_; }

private:
    bool joins(Tick tick) const;

    step_batch_t batch_;
    Publish publish_;
    Ticks period_;
    Tick due_;                // the axis's next turn
    Tick last_step_;          // last step of the batch, if it is not empty
    std::int64_t moved_ = 0;  // displacement by the batch's steps
};

}  // namespace lockstep
