// The clock of a process, in ticks. With the time sources SHARED and NETWORK it is CLOCK_MONOTONIC, which begins at the
// host's start and does not jump when the wall clock is set. With PTP it is CLOCK_TAI, which the PTP service
// synchronizes on all hosts.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

#include "core/machine.hpp"
#include "core/units.hpp"
#include "services/runtime/clock_error.hpp"

namespace lockstep {

/// Nanoseconds of CLOCK_MONOTONIC.
std::chrono::nanoseconds monotonic_now();

constexpr timespec to_timespec(std::chrono::nanoseconds time) {
    return {.tv_sec = time.count() / 1'000'000'000, .tv_nsec = time.count() % 1'000'000'000};
}

class MachineClock {
public:
    /// `tick_ns`: nanoseconds in a tick, at least 1. `error`: for tests; it applies from now on.
    explicit MachineClock(std::int64_t tick_ns, TimeSource source = TimeSource::Shared, const ClockError& error = {});

    /// The last tick that has begun.
    Tick now() const { return tick_at(read()); }
    Tick tick_at(std::chrono::nanoseconds time) const { return {time.count() / tick_ns_}; }
    std::chrono::nanoseconds time_of(Tick tick) const { return std::chrono::nanoseconds{tick.value * tick_ns_}; }
    /// Microseconds of machine time, as in LCM messages.
    std::int64_t utime_of(Tick tick) const { return time_of(tick).count() / 1000; }

private:
    std::chrono::nanoseconds read() const;

    std::int64_t tick_ns_;
    TimeSource source_;
    ClockError error_;
    std::chrono::nanoseconds start_;
};

}  // namespace lockstep
