#include "services/runtime/periodic.hpp"

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "services/runtime/clock.hpp"

namespace lockstep {

using std::chrono::nanoseconds;

void PeriodicLoop::start() { next_ = monotonic_now() / period_ * period_; }

bool PeriodicLoop::wait_for_next(const StopSignal& stop) {
    const nanoseconds now = monotonic_now();
    const std::int64_t missed = std::max<std::int64_t>(0, (now - next_) / period_);
    skipped_ += static_cast<std::uint64_t>(missed);
    next_ += period_ * (missed + 1);
    const timespec wake = to_timespec(next_);
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) {
        if (stop.requested()) { return false; }
    }
    worst_lateness_ = std::max(worst_lateness_, monotonic_now() - next_);
    return !stop.requested();
}

}  // namespace lockstep
