#include "services/runtime/loop_watchdog.hpp"

#include <utility>

#include "services/runtime/real_time.hpp"
#include "services/runtime/sleep.hpp"

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
    std::uint64_t seen = loops_;
    for (int looks = 0; looks < kLooks;) {
        if (!sleep_unless(stop, between_looks_)) { return; }
        const std::uint64_t loops = loops_.load(std::memory_order_relaxed);
        looks = loops == seen ? looks + 1 : 0;
        seen = loops;
    }
    on_stuck_();
}

}  // namespace lockstep
