#include "services/runtime/loop_watchdog.hpp"

#include <condition_variable>
#include <mutex>
#include <utility>

#include "services/runtime/real_time.hpp"

namespace lockstep {
namespace {

constexpr int kLooks = 50;  // consecutive checks without a loop between them

}  // namespace

LoopWatchdog::LoopWatchdog(std::function<void()> on_stuck, std::chrono::milliseconds longest)
    : on_stuck_(std::move(on_stuck)),
      between_looks_(longest / kLooks),
      thread_([this](const std::stop_token& stop) { watch(stop); }) {}

void LoopWatchdog::watch(const std::stop_token& stop) {
    leave_real_time();
    std::mutex mutex;
    std::condition_variable_any wake;
    std::uint64_t seen = loops_;
    for (int looks = 0; looks < kLooks;) {
        std::unique_lock lock(mutex);
        if (wake.wait_for(lock, stop, between_looks_, [&] { return stop.stop_requested(); })) { return; }
        const std::uint64_t loops = loops_.load(std::memory_order_relaxed);
        looks = loops == seen ? looks + 1 : 0;
        seen = loops;
    }
    on_stuck_();
}

}  // namespace lockstep
