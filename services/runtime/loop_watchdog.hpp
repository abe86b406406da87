// Ends a process whose loop stands still, so that its supervisor starts it again.
//
// A call into a library may never return, for example after damaged packets. The axes then rest by themselves, but the
// process would be missing for good. The watchdog counts its own checks, not time: while the whole process stands still
// it does not check either, and the process goes on.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

namespace lockstep {

inline constexpr std::chrono::seconds kLongestLoop{5};

class LoopWatchdog {
public:
    /// on_stuck: called once, in the watchdog's thread, after the loop has not run for `longest`; it must not wait for
    /// the loop.
    explicit LoopWatchdog(std::function<void()> on_stuck, std::chrono::milliseconds longest = kLongestLoop);

    /// The loop calls it each time.
    void note_loop() { loops_.fetch_add(1, std::memory_order_relaxed); }

private:
    void watch(const std::stop_token& stop);

    std::function<void()> on_stuck_;
    std::chrono::milliseconds between_looks_;
    std::atomic<std::uint64_t> loops_ = 0;
    std::jthread thread_;  // ends first
};

}  // namespace lockstep
