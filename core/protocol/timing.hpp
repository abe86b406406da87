// The times of the setpoint protocol, as configured.
#pragma once

#include <cstdint>

#include "core/protocol/rules.inc"

namespace lockstep {

/// Where machine time comes from (core/clock). Shared: all processes read one host's clock. Network: axes estimate the
/// coordinator's clock from exchanges with it. Ptp: a PTP service keeps the TAI clocks of all hosts equal.
enum class TimeSource : std::uint8_t { Shared, Network, Ptp };

/// The setpoint protocol's times, in slots (see rules.hpp). A slot lasts slot_us microseconds.
struct ProtocolTiming {
    std::int64_t slot_us = 10'000;
    int stall_slots = 10;       // s: how long a process may stall without effect on the motion
    int late_check_slots = 2;   // e, 0 to s: how late a check may be while another process fails
    int freshness_slots = 11;   // m >= s + 1
    int send_ahead_slots = 31;  // A >= V + m + s + 4
    int frame_slots = 5;
    int segment_entries = 1024;  // of the devices' smallest segment ring (sim_fpga/registers.json)
    int output_entries = 1024;   // of the smallest output ring of a device whose outputs are used
    TimeSource time_source = TimeSource::Shared;
    std::int64_t jog_hold_us = 20'000;         // how long a jog continues after a renewal reaches the coordinator
    std::int64_t clock_error_limit_us = 2500;  // for axes in coordinated moves; at most most_clock_error_us()

    constexpr int check_slots() const { return RULE_CHECK_AHEAD(late_check_slots); }          // V
    constexpr int lease_slots() const { return RULE_LEASE(check_slots(), freshness_slots); }  // V + m + 1
    constexpr int send_deadline_slots() const { return RULE_SEND_DEADLINE(check_slots(), freshness_slots); }
    /// The clock error for which a hop has room (core/protocol/rules.hpp) if the network takes half a slot.
    constexpr std::int64_t most_clock_error_us() const { return RULE_MOST_CLOCK_ERROR(slot_us, slot_us / 2); }
};

}  // namespace lockstep
