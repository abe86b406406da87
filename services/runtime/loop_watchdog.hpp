// Ends a process if its loop is stuck, so that its supervisor starts it again.
//
// A call into a library may never return, for example after damaged packets. The axes then come to rest without it, but
// the process would stay missing. The watchdog counts its own checks, not time, so a stall of the whole process does
// not end it.
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
    /// Calls on_stuck once, in the watchdog's thread, when the loop has not run for `longest`. on_stuck must not wait
    /// for the loop.
    explicit LoopWatchdog(std::function<void()> on_stuck, std::chrono::milliseconds longest = kLongestLoop);

    /// Call it in each loop.
    void note_loop() { loops_.fetch_add(1, std::memory_order_relaxed); }

private:
    void watch(const std::stop_token& stop);

    std::function<void()> on_stuck_;
    std::chrono::milliseconds between_looks_;
    std::atomic<std::uint64_t> loops_ = 0;
    std::jthread thread_;  // declared last, so that it ends first
};

}  // namespace lockstep
