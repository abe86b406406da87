#include "services/runtime/clock.hpp"

#include <ctime>

namespace lockstep {
namespace {

std::chrono::nanoseconds read_clock(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return std::chrono::seconds{now.tv_sec} + std::chrono::nanoseconds{now.tv_nsec};
}

}  // namespace

std::chrono::nanoseconds monotonic_now() { return read_clock(CLOCK_MONOTONIC); }

MachineClock::MachineClock(std::int64_t tick_ns, TimeSource source, const ClockError& error)
    : tick_ns_(tick_ns), source_(source), error_(error), start_(monotonic_now()) {}

std::chrono::nanoseconds MachineClock::read() const {
    const std::chrono::nanoseconds monotonic = monotonic_now();
    const std::chrono::nanoseconds time = source_ == TimeSource::Ptp ? read_clock(CLOCK_TAI) : monotonic;
    return error_.applied(time, monotonic - start_);
}

}  // namespace lockstep
