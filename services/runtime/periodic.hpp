// A loop that wakes at whole multiples of its period on CLOCK_MONOTONIC. Loops of the same period in different
// processes wake together. A loop that wakes late skips the missed periods instead of running them in a burst.
#pragma once

#include <chrono>
#include <cstdint>

#include "services/runtime/stop_signal.hpp"

namespace lockstep {

class PeriodicLoop {
public:
    /// `period` is more than 0.
    explicit PeriodicLoop(std::chrono::nanoseconds period) : period_(period) {}

    /// Calls step(time) once a period until a stop is requested. `time` is the scheduled wake-up time on
    /// CLOCK_MONOTONIC.
    template <typename Step>
    void run(const StopSignal& stop, Step step) {
        start();
        while (wait_for_next(stop)) { step(next_); }
    }

    /// Periods in which the loop did not wake because it was late.
    std::uint64_t skipped_periods() const { return skipped_; }
    /// The largest delay of a wake-up.
    std::chrono::nanoseconds worst_lateness() const { return worst_lateness_; }

private:
    void start();
    bool wait_for_next(const StopSignal& stop);

    std::chrono::nanoseconds period_;
    std::chrono::nanoseconds next_{};
    std::chrono::nanoseconds worst_lateness_{};
    std::uint64_t skipped_ = 0;
};

}  // namespace lockstep
