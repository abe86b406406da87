// Collects the steps of one axis into messages: one each kBatchPeriod, and one more whenever a message is full. The
// axes' turns are spread over the period, so that a logger does not receive all of them at once.
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
    static constexpr std::int32_t kMaxSteps = 2000;  // 10 KB: larger messages need more fragments without benefit

    struct Source {
        std::string machine;
        std::string axis;
        std::uint32_t axis_index = 0;
        std::uint64_t incarnation = 0;  // of the axis's process
        std::int64_t tick_ns = 1000;
    };

    StepBatcher(Source source, std::int64_t position_steps, Publish publish);

    /// Steps come in the order of their ticks.
    void add(StepEdge step);

    /// Publishes the collected steps if it is the axis's turn. Call it once a loop, with the device's time. An axis at
    /// rest publishes nothing.
    void poll(Tick now);

    /// Publishes the collected steps.
    void flush();

    /// The count jumps without steps: the axis was zeroed, or the times of some steps were lost. Publishes the
    /// collected steps first, so that a reader sees the jump between two batches.
    void set_position(std::int64_t position_steps);

    std::int64_t position_steps() const { return batch_.position_before + moved_; }

private:
    bool joins(Tick tick) const;

    step_batch_t batch_;
    Publish publish_;
    Ticks period_;
    Tick due_;                // the axis's next turn
    Tick last_step_;          // of the batch, if it is not empty
    std::int64_t moved_ = 0;  // by the batch's steps
};

}  // namespace lockstep
