// The times of the setpoint protocol, as configured.
#pragma once

#include <cstdint>

#include "core/protocol/rules.inc"

namespace lockstep {

/// Where machine time comes from (core/clock). Shared: all processes read one host's clock. Network: axes estimate the
/// coordinator's by asking. Ptp: every host's TAI clock is held to the others' by a PTP service.
enum class TimeSource : std::uint8_t { Shared, Network, Ptp };

/// The setpoint protocol's times, in slots (see rules.hpp). Lengths: slot_us microseconds each.
struct ProtocolTiming {
    std::int64_t slot_us = 10'000;
    int stall_slots = 10;       // s: how long a process may stall and the machine still runs on
    int late_check_slots = 2;   // e, 0 to s: how late a check may be beside a fault of another process
    int freshness_slots = 11;   // m >= s + 1
    int send_ahead_slots = 31;  // A >= V + m + s + 4
    int frame_slots = 5;
    TimeSource time_source = TimeSource::Shared;
    std::int64_t jog_hold_us = 20'000;         // how long a jog goes on after a renewal has reached the coordinator
    std::int64_t clock_error_limit_us = 2500;  // of an axis's machine time, to move; at most most_clock_error_us()

    constexpr int check_slots() const { return RULE_CHECK_AHEAD(late_check_slots); }          // V
    constexpr int lease_slots() const { return RULE_LEASE(check_slots(), freshness_slots); }  // V + m + 1
    constexpr int send_deadline_slots() const { return RULE_SEND_DEADLINE(check_slots(), freshness_slots); }
    /// What a hop leaves for the error of two clocks (core/protocol/rules.hpp), half a slot being the network's.
    constexpr std::int64_t most_clock_error_us() const { return RULE_MOST_CLOCK_ERROR(slot_us, slot_us / 2); }
};

}  // namespace lockstep
