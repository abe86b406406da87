// Machine time: CLOCK_MONOTONIC, which all processes of one host share. The tick is its nanoseconds in units of
// tick_ns. It does not jump when the wall clock is set, and its origin is the host's start.
#pragma once

#include <chrono>
#include <cstdint>

#include "core/units.hpp"

namespace lockstep {

/// Nanoseconds of CLOCK_MONOTONIC.
std::chrono::nanoseconds monotonic_now();

class MachineClock {
public:
    /// tick_ns: nanoseconds in a tick, at least 1.
    explicit MachineClock(std::int64_t tick_ns) : tick_ns_(tick_ns) {}

    /// The last tick that has begun.
    Tick now() const { return tick_at(monotonic_now()); }
    Tick tick_at(std::chrono::nanoseconds time) const { return {time.count() / tick_ns_}; }
    std::chrono::nanoseconds time_of(Tick tick) const { return std::chrono::nanoseconds{tick.value * tick_ns_}; }
    /// Microseconds of machine time, as LCM messages carry it.
    std::int64_t utime_of(Tick tick) const { return time_of(tick).count() / 1000; }

private:
    std::int64_t tick_ns_;
};

}  // namespace lockstep
