#include "services/runtime/user_signal.hpp"

#include <atomic>

namespace lockstep {
namespace {

std::atomic<bool> has_come{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only use lock-free atomics");

extern "C" void on_user_signal(int) { has_come.store(true, std::memory_order_relaxed); }

}  // namespace

UserSignal::UserSignal() {
    has_come = false;
    struct sigaction action {};
    action.sa_handler = on_user_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGUSR1, &action, &before_);
}

UserSignal::~UserSignal() { sigaction(SIGUSR1, &before_, nullptr); }

bool UserSignal::take() { return has_come.exchange(false, std::memory_order_relaxed); }

}  // namespace lockstep
