// A loop at whole multiples of its period on CLOCK_MONOTONIC: loops of the same period in different processes wake
// together, and a loop that wakes late skips what it missed rather than running it in a burst.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "services/runtime/stop_signal.hpp"

namespace lockstep {

class PeriodicLoop {
public:
    /// period: more than 0. offset: how long after each multiple of the period it wakes.
    explicit PeriodicLoop(std::chrono::nanoseconds period, std::chrono::nanoseconds offset = {})
        : period_(period), offset_(offset) {}

    /// Calls step(the time it was to wake, on CLOCK_MONOTONIC) once a period until a stop is requested.
    template <typename Step>
    void run(const StopSignal& stop, Step step) {
        start();
        while (wait_for_next(stop)) { step(next_); }
    }

    /// Periods in which the loop did not wake because it was late.
    std::uint64_t skipped_periods() const { return skipped_; }
    /// The latest it has ever woken after its time.
    std::chrono::nanoseconds worst_lateness() const { return worst_lateness_; }

private:
    void start();
    bool wait_for_next(const StopSignal& stop);

    std::chrono::nanoseconds period_;
    std::chrono::nanoseconds offset_;
    std::chrono::nanoseconds next_{};
    std::chrono::nanoseconds worst_lateness_{};
    std::uint64_t skipped_ = 0;
};

/// Asks for SCHED_FIFO for this thread and those it starts after, and says in one line what came of it. Call it
/// before a DDS participant is made: its threads inherit the scheduler. priority: 1 ... 99.
std::string try_real_time(int priority);

/// This thread need not be in time: it goes back to the normal scheduler.
void leave_real_time();

}  // namespace lockstep
