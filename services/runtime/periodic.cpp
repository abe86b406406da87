#include "services/runtime/periodic.hpp"

#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using std::chrono::nanoseconds;

timespec to_timespec(nanoseconds time) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    return {.tv_sec = time.count() / kSecond, .tv_nsec = time.count() % kSecond};
}

}  // namespace

void PeriodicLoop::start() { next_ = (monotonic_now() - offset_) / period_ * period_ + offset_; }

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

std::string try_real_time(int priority) {
    const sched_param wanted{.sched_priority = priority};
    if (sched_setscheduler(0, SCHED_FIFO, &wanted) == 0) {
        return "scheduler FIFO, priority " + std::to_string(priority);
    }
    return std::string("scheduler normal: FIFO was refused (") + std::strerror(errno) +
           "); to permit it: LimitRTPRIO=99 in the unit, or --ulimit rtprio=99 --cap-add SYS_NICE for a container";
}

void leave_real_time() {
    const sched_param normal{.sched_priority = 0};
    (void)sched_setscheduler(0, SCHED_OTHER, &normal);
}

}  // namespace lockstep
