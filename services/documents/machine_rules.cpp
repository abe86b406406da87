#include "services/documents/machine_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/coordinator/path/coordination.hpp"
#include "core/coordinator/path/lai_path.hpp"
#include "core/coordinator/path/touched_outputs.hpp"
#include "core/protocol/frame_room.hpp"
#include "core/protocol/peer_evidence.hpp"
#include "core/protocol/rules.inc"
#include "services/documents/names.hpp"
#include "services/documents/placement.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {
namespace {

constexpr int kMaxSlots = 10'000;
// Of a device's rings, as in sim_fpga/registers.json.
constexpr int kMostSegmentEntries = 4096;
constexpr int kLeastOutputEntries = 16;
constexpr int kMostOutputEntries = 1024;
constexpr std::int64_t kLeastClockTicks = 16;
constexpr std::int64_t kLeastSlotTicks = 4;  // processes loop up to four times in a slot, and once in a tick at most
constexpr std::uint32_t kMaxDomain = 232;    // the last domain with ports below 65536 (DDS interoperability, 9.6.1)
constexpr std::size_t kMaxInterfaceName = 64;
constexpr std::size_t kMaxPeers = 64;

void check_timing(const MachineConfig& machine, ProblemList& problems) {
    const ProtocolTiming& t = machine.timing;
    problems.require_range("timing.slot_us", static_cast<double>(t.slot_us), 500, 1e6);
    problems.require_between(
        {"timing.slot_us", "tick_ns"}, machine.tick_ns == 0 || Int128{t.slot_us} * 1000 % machine.tick_ns == 0,
        fmt::format("timing.slot_us is {}, not a whole number of ticks of {} ns; choose another slot or tick_ns",
                    t.slot_us, machine.tick_ns));
    const std::int64_t least_us = (kLeastSlotTicks * machine.tick_ns + 999) / 1000;
    problems.require_between(
        {"timing.slot_us", "tick_ns"}, t.slot_us >= least_us,
        fmt::format("timing.slot_us is {}; it must be at least {}, {} ticks of {} ns, because processes loop up to "
                    "four times in a slot; increase it, or decrease tick_ns",
                    t.slot_us, least_us, kLeastSlotTicks, machine.tick_ns));
    problems.require_range("timing.stall_slots", t.stall_slots, 1, kMaxStallSlots);
    problems.require_range("timing.freshness_slots", t.freshness_slots, 1, kMaxStallSlots + 50);
    problems.require_range("timing.send_ahead_slots", t.send_ahead_slots, 1, kMaxSlots);
    problems.require_range("timing.frame_slots", t.frame_slots, 1, kMaxSlots);
    problems.require_range("timing.segment_entries", t.segment_entries, kLeastSegmentEntries, kMostSegmentEntries);
    problems.require_range("timing.output_entries", t.output_entries, kLeastOutputEntries, kMostOutputEntries);
    problems.require_range("timing.jog_hold_ms", static_cast<double>(t.jog_hold_us) / 1000, 20, 500);
}

/// Checks the setpoint protocol's inequalities.
void check_protocol(const ProtocolTiming& t, ProblemList& problems) {
    const auto require = [&](std::string_view key, int value, int least, const std::string& rule) {
        problems.require_between({key, "timing.stall_slots", "timing.freshness_slots"}, value >= least,
                                 fmt::format("{} is {}; it must be at least {} ({})", key, value, least, rule));
    };
    const int s = t.stall_slots;
    const int m = t.freshness_slots;
    require("timing.freshness_slots", m, RULE_LEAST_FRESHNESS(s), "stall_slots + 1");
    problems.require_between(
        {"timing.late_check_slots", "timing.stall_slots"}, t.late_check_slots >= 0 && t.late_check_slots <= s,
        fmt::format("timing.late_check_slots is {}; it must be from 0 to stall_slots, {}", t.late_check_slots, s));
    require("timing.send_ahead_slots", t.send_ahead_slots, RULE_LEAST_SEND_AHEAD(t.check_slots(), m, s),
            "freshness_slots + stall_slots + late_check_slots + 8");
    const bool is_in_range =
        t.send_ahead_slots > 0 && t.send_ahead_slots <= kMaxSlots && t.segment_entries >= kLeastSegmentEntries;
    const int least = is_in_range ? least_frame_slots(t) : 1;
    problems.require_between(
        {"timing.frame_slots", "timing.send_ahead_slots", "timing.segment_entries"}, t.frame_slots >= least,
        fmt::format("timing.frame_slots is {}; it must be at least {}, so that a device has room in {} entries "
                    "(segment_entries) for all frames that are sent {} slots ahead (send_ahead_slots)",
                    t.frame_slots, least, t.segment_entries, t.send_ahead_slots));
}

/// A body and its tail have room for the changes that any events may make. No output ring has more entries than usual.
void check_output_room(const MachineConfig& machine, ProblemList& problems) {
    const ProtocolTiming& t = machine.timing;
    if (t.frame_slots < 1 || t.send_ahead_slots < 1) { return; }  // reported above
    if (t.output_entries == kMostOutputEntries) { return; }
    const std::size_t least = TouchedOutputs::least_room(machine.outputs);
    const int frames = frames_ahead(t);
    problems.require_between(
        {"timing.output_entries", "timing.frame_slots", "timing.send_ahead_slots"}, output_room(t).tail >= least,
        fmt::format(
            "timing.output_entries is {}; it must be at least {}, for {} changes in the body and {} in the tail "
            "of each of {} frames that are sent ahead; increase it, or timing.frame_slots",
            t.output_entries, 2 * least * static_cast<std::size_t>(frames), least, least, frames));
}

/// With PTP an axis reports the whole limit as the error of its host's clock.
void check_device_clocks(const MachineConfig& machine, ProblemList& problems) {
    if (machine.timing.time_source != TimeSource::Ptp) { return; }
    for (const AxisConfig& axis : machine.axes) {
        problems.require(!axis.device.has_own_clock(), "timing.time_source",
                         "timing.time_source is PTP, which leaves no room for the clock error of device " +
                             axis.device.text() + " of axis " + axis.name + "; set NETWORK");
    }
}

/// Checks the limit of the clock error. In the setpoint protocol a hop must cover twice this error and the network's
/// delay.
void check_clocks(const MachineConfig& machine, ProblemList& problems) {
    const ProtocolTiming& t = machine.timing;
    if (t.time_source == TimeSource::Shared && !machine.estimates_clocks()) { return; }
    const std::int64_t most = t.most_clock_error_us();
    problems.require_between(
        {"timing.clock_error_limit_us", "timing.slot_us"},
        t.clock_error_limit_us >= 1 && t.clock_error_limit_us <= most,
        fmt::format(
            "timing.clock_error_limit_us is {}; it must be from 1 to {} (a quarter of slot_us); decrease it, or "
            "increase slot_us",
            t.clock_error_limit_us, most));
    if (!machine.estimates_clocks()) { return; }
    const std::int64_t least = (kLeastClockTicks * machine.tick_ns + 999) / 1000;
    problems.require_between(
        {"timing.clock_error_limit_us", "timing.slot_us", "tick_ns"}, t.clock_error_limit_us >= least,
        fmt::format("timing.clock_error_limit_us is {}; it must be at least {}, {} ticks of {} ns, because clocks are "
                    "measured in ticks; increase it and timing.slot_us, or decrease tick_ns",
                    t.clock_error_limit_us, least, kLeastClockTicks, machine.tick_ns));
}

bool is_interface_name(std::string_view name) {
    const auto may_stand = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("_-.:@").contains(c);
    };
    return !name.empty() && name.size() <= kMaxInterfaceName && std::ranges::all_of(name, may_stand);
}

bool is_lcm_url(std::string_view url) {
    const auto printable = [](char c) { return c > ' ' && c <= '~'; };
    return std::ranges::all_of(url, printable) &&
           (url.starts_with("udpm://") || url.starts_with("memq://") || url.starts_with("tcpq://"));
}

void check_peers(const std::vector<std::string>& peers, ProblemList& problems) {
    problems.require(peers.size() <= kMaxPeers, "network",
                     fmt::format("network.peers has {} hosts; it can have at most {}", peers.size(), kMaxPeers));
    for (const std::string& peer : peers) {
        problems.require(is_host_name(peer), "network",
                         "network.peers has \"" + peer +
                             "\"; it must be an IPv4 address or a host's name: letters, digits, - and .");
    }
}

void check_network(const NetworkConfig& network, ProblemList& problems) {
    problems.require(is_interface_name(network.interface), "network.interface",
                     "network.interface is \"" + network.interface + "\"; name an interface, such as lo or eth0");
    problems.require_range("network.domain", network.domain, 0, kMaxDomain);
    problems.require(is_lcm_url(network.lcm_url), "network.lcm_url",
                     "network.lcm_url is \"" + network.lcm_url + "\"; it must begin with udpm://, tcpq:// or memq://");
    check_peers(network.peers, problems);
}

void check_directory(const std::string& key, const std::string& directory, ProblemList& problems) {
    problems.require(directory.empty() || directory.starts_with('/'), key,
                     fmt::format("{} is \"{}\"; it must be an absolute path, such as /var/lib/lockstep; or remove it",
                                 key, directory));
}

void check_record(const RecordConfig& record, ProblemList& problems) {
    check_directory("record.directory", record.directory, problems);
    problems.require_range("record.size_limit_mb", static_cast<double>(record.size_limit_mb), 1, 1e6);
    problems.require_range("record.flight.memory_kb", static_cast<double>(record.flight.memory_kb), 64, 65536);
    problems.require_range("record.flight.files", record.flight.files, 1, 1000);
}

void check_real_time(const RealTimeConfig& real_time, ProblemList& problems) {
    constexpr int kMaxCpu = 1023;  // the last processor of a cpu_set_t
    problems.require_range("real_time.priority", real_time.priority, 0, 99);
    for (const int cpu : real_time.cpus) {
        problems.require(cpu >= 0 && cpu <= kMaxCpu, "real_time",
                         fmt::format("real_time.cpus has {}; processors are numbered from 0 to {}", cpu, kMaxCpu));
    }
}

void check_web(const WebConfig& web, ProblemList& problems) {
    problems.require(
        is_ip_address(web.address), "web.address",
        "web.address is \"" + web.address + "\"; it must be an IP address, such as 127.0.0.1, ::1 or 0.0.0.0");
    problems.require_range("web.port", web.port, 1, 65535);
    check_directory("web.certificate_file", web.certificate_file, problems);
    check_directory("web.key_file", web.key_file, problems);
    const bool has_certificate = !web.certificate_file.empty();
    const std::string lacking = has_certificate ? "key_file" : "certificate_file";
    problems.require(
        has_certificate == !web.key_file.empty(), "web",
        "web." + lacking + " is missing; HTTPS needs certificate_file and key_file; plain HTTP needs neither");
    problems.require_between(
        {"web.address", "web"}, has_certificate || is_loopback_address(web.address),
        "web.address is \"" + web.address +
            "\", which other hosts can reach, and other hosts are served with TLS only; add certificate_file "
            "and key_file, or set web.address: \"127.0.0.1\" and use an SSH tunnel");
    for (const std::string& name : web.host_names) {
        problems.require(
            is_host_name(name), "web",
            "web.host_names has \"" + name + "\"; it must be the name of a host: letters, digits, - and .");
    }
}

/// Different hosts have different clocks, and cannot exchange messages over lo.
void check_hosts(const MachineSetup& machine, ProblemList& problems) {
    problems.require(machine.coordinator_host.empty() || is_host_name(machine.coordinator_host), "coordinator_host",
                     "coordinator_host is \"" + machine.coordinator_host +
                         "\"; it must be the name of a host: letters, digits, - and .");
    problems.require(!machine.network.one_host || machine.network.peers.empty(), "network.one_host",
                     "network.one_host is true, but network.peers names other hosts; remove one of them");
    const std::vector<std::string> hosts = hosts_of(machine);
    if (hosts.size() < 2) { return; }
    const std::string several = fmt::format("the machine is on several hosts, such as {} and {}", hosts[0], hosts[1]);
    problems.require(machine.timing.time_source != TimeSource::Shared, "timing.time_source",
                     "timing.time_source is SHARED, the clock of one host, but " + several + "; set NETWORK or PTP");
    problems.require(machine.network.interface != "lo", "network.interface",
                     "network.interface is lo, but " + several + "; name the interface that connects them");
    problems.require(!machine.network.one_host, "network.one_host",
                     "network.one_host is true, but " + several + "; set it to false");
}

}  // namespace

std::vector<Problem> machine_problems(const MachineSetup& machine) {
    ProblemList problems;
    problems.require(
        is_machine_name(machine.name), "name",
        fmt::format("name is \"{}\"; it must be a letter, then letters, digits, _ and -, at most {} characters",
                    machine.name, kMaxMachineName));
    problems.require_range("tick_ns", static_cast<double>(machine.tick_ns), 100, 1e6);
    check_timing(machine, problems);
    check_protocol(machine.timing, problems);
    check_output_room(machine, problems);
    check_clocks(machine, problems);
    check_device_clocks(machine, problems);
    check_network(machine.network, problems);
    check_directory("security.directory", machine.security.directory, problems);
    check_record(machine.record, problems);
    check_directory("position_directory", machine.position_directory, problems);
    check_directory("subroutine_directory", machine.subroutine_directory, problems);
    check_real_time(machine.real_time, problems);
    if (machine.web) { check_web(*machine.web, problems); }
    check_hosts(machine, problems);
    problems.require(
        !machine.axes.empty() && machine.axes.size() <= kMaxAxes, "",
        fmt::format("the machine has {} axes; it must have from 1 to {}: write one axis {{ ... }} for each",
                    machine.axes.size(), kMaxAxes));
    if (!coordination_of(machine).suits_all_axes && problems.empty()) {
        const auto suits = suits_lai_path(machine);
        problems.require(suits.has_value(), "coordination", suits ? "" : text_of(suits.error()));
    }
    return problems.take();
}

}  // namespace lockstep
