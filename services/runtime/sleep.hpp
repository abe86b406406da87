// A pause of a thread that ends early when the thread is to stop.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>

namespace lockstep {

/// Returns false if the thread must stop.
inline bool sleep_unless(const std::stop_token& stop, std::chrono::nanoseconds time) {
    std::mutex mutex;
    std::condition_variable_any wake;
    std::unique_lock lock(mutex);
    return !wake.wait_for(lock, stop, time, [&] { return stop.stop_requested(); });
}

}  // namespace lockstep
