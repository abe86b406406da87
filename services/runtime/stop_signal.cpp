#include "services/runtime/stop_signal.hpp"

#include <atomic>

namespace lockstep {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only use lock-free atomics");

extern "C" void on_stop_signal(int) { stop_requested.store(true, std::memory_order_relaxed); }

}  // namespace

StopSignal::StopSignal() {
    stop_requested = false;
    struct sigaction action {};
    action.sa_handler = on_stop_signal;  // without SA_RESTART, so that a sleeping loop wakes at once
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &interrupt_before_);
    sigaction(SIGTERM, &action, &terminate_before_);
}

StopSignal::~StopSignal() {
    sigaction(SIGINT, &interrupt_before_, nullptr);
    sigaction(SIGTERM, &terminate_before_, nullptr);
}

bool StopSignal::requested() const { return stop_requested.load(std::memory_order_relaxed); }

void StopSignal::request() { stop_requested = true; }

}  // namespace lockstep
