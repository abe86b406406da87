// Flags that signals set and loops check.
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>

namespace lockstep {

/// The signals set the flag while the object exists. At most one object of a type exists in a process, because all
/// share one flag. The destructor restores the previous handlers.
template <int... kSignals>
class SignalFlag {
public:
    /// `flags` are those of sigaction.
    explicit SignalFlag(int flags) {
        is_set_ = false;
        struct sigaction action {};
        action.sa_handler = [](int) { is_set_.store(true, std::memory_order_relaxed); };
        action.sa_flags = flags;
        sigemptyset(&action.sa_mask);
        std::size_t i = 0;
        (sigaction(kSignals, &action, &before_[i++]), ...);
    }
    ~SignalFlag() {
        std::size_t i = 0;
        (sigaction(kSignals, &before_[i++], nullptr), ...);
    }
    SignalFlag(const SignalFlag&) = delete;
    SignalFlag& operator=(const SignalFlag&) = delete;

protected:
    static inline std::atomic<bool> is_set_{false};
    static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only use lock-free atomics");
    std::array<struct sigaction, sizeof...(kSignals)> before_{};
};

/// SIGINT and SIGTERM ask the process to end. They wake a loop that sleeps at once.
class StopSignal : public SignalFlag<SIGINT, SIGTERM> {
public:
    StopSignal() : SignalFlag(0) {}
    bool requested() const { return is_set_.load(std::memory_order_relaxed); }
    /// Acts as if the signal had arrived. For a service that ends itself.
    void request() { is_set_ = true; }
};

class UserSignal : public SignalFlag<SIGUSR1> {
public:
    UserSignal() : SignalFlag(SA_RESTART) {}
    /// Returns whether SIGUSR1 arrived since the last call.
    bool take() { return is_set_.exchange(false, std::memory_order_relaxed); }
};

}  // namespace lockstep
