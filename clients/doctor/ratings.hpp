// Compares host facts with the machine's requirements. Pure: the caller measures.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "clients/doctor/finding.hpp"
#include "core/kinematics/motors.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep::doctor {

struct InterfaceFacts {
    bool exists = false;
    bool up = false;
    bool has_address = false;  // of IPv4
    bool multicast = false;    // as the interface reports it; lo does not report it, but supports it
};
Finding rate_interface(const NetworkConfig& network, const InterfaceFacts& facts);

/// route: the result of check_multicast. received: whether a datagram sent by LCM came back; nullopt if not tried.
Finding rate_route(const NetworkConfig& network, const std::expected<void, std::string>& route,
                   std::optional<bool> received);

/// The receive buffer that an LCM URL requests, in bytes.
std::optional<std::int64_t> buffer_asked(const std::string& lcm_url);
/// The size of the receive buffer in bytes: `asked` by the URL, `given` by the kernel.
Finding rate_buffer(std::int64_t asked, std::int64_t given);
/// The size of the send buffer in bytes: `needed` for the machine's peers (peer_send_buffer), `given` by the kernel.
Finding rate_send_buffer(std::int64_t needed, std::int64_t given);

/// memory: the file of the axes' states with network.one_host, or the reason why it cannot be created.
Finding rate_states(const MachineSetup& machine, const std::expected<std::string, std::string>& memory);

/// Each text is the reason for a refusal, or empty if the host permits it.
struct RealTimeFacts {
    std::string scheduler;
    std::string memory;
};
Finding rate_scheduler(const RealTimeConfig& wanted, const RealTimeFacts& facts);
Finding rate_memory(const RealTimeConfig& wanted, const RealTimeFacts& facts);

/// The delays with which a thread woke that was scheduled every quarter of a slot.
struct StallFacts {
    double worst_us = 0;
    double p99_us = 0;
    double seconds = 0;  // duration of the measurement
};
Finding rate_stalls(const ProtocolTiming& timing, const StallFacts& facts);
/// The shortest timing with which a host may stall for twice as long as measured, for the clocks and the devices' rings
/// of a machine that has the timing `today`.
ProtocolTiming timing_for(const StallFacts& facts, const ProtocolTiming& today = {});

struct ClockFacts {
    std::string source;               // the kernel's clocksource
    bool synchronised = false;        // by a time service, as the kernel reports
    std::optional<int> tai_offset_s;  // of CLOCK_TAI; nullopt: not set
};
Finding rate_clock(TimeSource source, const ClockFacts& facts);

/// answer: the result of attaching to the device.
Finding rate_device(const MotorConfig& axis, const std::expected<void, std::string>& answer);

/// lacks: why the board does not answer, or how its devices do not suit their motors.
Finding rate_board(const BoardLinkConfig& board, const std::vector<std::string>& lacks);

/// not_writable: the reason why `path` cannot be written, or empty.
Finding rate_directory(const std::string& what, const std::string& path, const std::string& not_writable);

/// A member's keys on this host.
struct KeyFacts {
    std::string member;
    bool here = false;
    bool is_out = false;  // it cannot join with these keys
    std::string trouble;  // a present or impending error with its remedy, or empty
    int days_left = 0;
};
Finding rate_keys(const KeyFacts& facts);

/// One of the machine's processes, as received from the network.
struct ProcessFacts {
    std::string name;
    bool received = false;
    std::uint64_t config_hash = 0;
    std::vector<std::string> hosts;  // on which this process runs
    bool may_be_two = false;         // for a coordinator and its standby
};
Finding rate_process(const ProcessFacts& facts, std::uint64_t config_hash);

}  // namespace lockstep::doctor
