// What a host is like, against what a machine needs of it. Pure: what was measured comes in.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "clients/doctor/finding.hpp"
#include "core/machine.hpp"

namespace lockstep::doctor {

struct InterfaceFacts {
    bool exists = false;
    bool up = false;
    bool has_address = false;  // of IPv4
    bool multicast = false;    // it says so itself; lo does not, and carries it all the same
};
Finding judge_interface(const NetworkConfig& network, const InterfaceFacts& facts);

/// route: what check_multicast says. heard: whether a datagram sent by LCM came back; no value: it was not tried.
Finding judge_route(const NetworkConfig& network, const std::expected<void, std::string>& route,
                    std::optional<bool> heard);

/// The receive buffer that an LCM URL asks for, in bytes; 0: none.
std::int64_t buffer_asked(const std::string& lcm_url);
/// Bytes of a receive buffer: what the URL asks for, what the kernel gave.
Finding judge_buffer(std::int64_t asked, std::int64_t given);
/// Bytes of a send buffer: what a machine's peers need (peer_send_buffer), what the kernel gave.
Finding judge_send_buffer(std::int64_t needed, std::int64_t given);

/// memory: where network.one_host has the axes' states, or why it cannot be had.
Finding judge_states(const MachineConfig& machine, const std::expected<std::string, std::string>& memory);

/// Empty: permitted; else why not.
struct RealTimeFacts {
    std::string scheduler;
    std::string memory;
};
Finding judge_scheduler(const RealTimeConfig& wanted, const RealTimeFacts& facts);
Finding judge_memory(const RealTimeConfig& wanted, const RealTimeFacts& facts);

/// How late a thread woke that wanted to wake each quarter of a slot.
struct StallFacts {
    double worst_us = 0;
    double p99_us = 0;
    double seconds = 0;  // so long it was looked at
};
Finding judge_stalls(const ProtocolTiming& timing, const StallFacts& facts);
/// The shortest timing with which a host may stall for twice as long as it was seen to.
ProtocolTiming timing_for(const StallFacts& facts);

struct ClockFacts {
    std::string source;         // the kernel's clocksource
    bool synchronised = false;  // some service says that it keeps the clock
    int tai_offset_s = 0;       // of CLOCK_TAI; 0: nobody has set it
};
Finding judge_clock(TimeSource source, const ClockFacts& facts);

/// answer: what attaching to the device said.
Finding judge_device(const AxisConfig& axis, const std::expected<void, std::string>& answer);

/// writable: empty, or why not.
Finding judge_directory(const std::string& what, const std::string& path, const std::string& not_writable);

/// A member's keys on this host.
struct KeyFacts {
    std::string member;
    bool here = false;
    bool is_out = false;  // by what is wrong with them it cannot join
    std::string trouble;  // what is wrong or will be soon, and the remedy; empty: nothing
    int days_left = 0;
};
Finding judge_keys(const KeyFacts& facts);

/// One of the machine's processes, as it is heard on the network.
struct ProcessFacts {
    std::string name;
    bool heard = false;
    std::uint64_t config_hash = 0;
    std::vector<std::string> hosts = {};  // on which processes of it run
    bool may_be_two = false;              // a coordinator, and another that stands by
};
Finding judge_process(const ProcessFacts& facts, std::uint64_t config_hash);

}  // namespace lockstep::doctor
