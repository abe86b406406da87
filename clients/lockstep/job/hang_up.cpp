#include "clients/lockstep/job/hang_up.hpp"

#include <atomic>

namespace lockstep {
namespace {

std::atomic<bool> hung_up{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only use lock-free atomics");

extern "C" void on_hang_up(int) { hung_up.store(true, std::memory_order_relaxed); }

}  // namespace

HangUp::HangUp() {
    hung_up = false;
    struct sigaction action {};
    action.sa_handler = on_hang_up;
    sigemptyset(&action.sa_mask);
    sigaction(SIGPIPE, &action, &pipe_before_);
    sigaction(SIGHUP, nullptr, &hang_up_before_);
    if (hang_up_before_.sa_handler != SIG_IGN) { sigaction(SIGHUP, &action, nullptr); }
}

HangUp::~HangUp() {
    sigaction(SIGPIPE, &pipe_before_, nullptr);
    sigaction(SIGHUP, &hang_up_before_, nullptr);
}

bool HangUp::came() const { return hung_up.load(std::memory_order_relaxed); }

}  // namespace lockstep
