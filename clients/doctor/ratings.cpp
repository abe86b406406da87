#include "clients/doctor/ratings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "core/if_positive.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/frame_room.hpp"
#include "services/documents/edit/timing_edit.hpp"

namespace lockstep::doctor {
namespace {

/// The shortest slot that the machine's clocks allow: four times the limit of their error, or 0 if the axes share one
/// clock.
std::int64_t least_slot_us(const ProtocolTiming& timing) {
    return timing.time_source == TimeSource::Shared ? 0 : 4 * timing.clock_error_limit_us;
}

std::string milliseconds(double us) { return fmt::format("{:.{}f} ms", us / 1000, us < 10'000 ? 2 : 0); }

}  // namespace

Finding rate_interface(const NetworkConfig& network, const InterfaceFacts& facts) {
    const std::string& name = network.interface;
    const auto bad = [](std::string found, std::string remedy) {
        return Finding{Rating::Bad, "interface", std::move(found), std::move(remedy)};
    };
    if (!facts.exists) {
        return bad("there is no interface " + name, "ip link; then network.interface in the machine's file");
    }
    if (!facts.up) { return bad(name + " is down", "ip link set " + name + " up"); }
    if (!facts.has_address) { return bad(name + " has no IPv4 address", "ip address add ADDRESS/24 dev " + name); }
    if (!facts.multicast && name != "lo" && network.peers.empty()) {
        return bad(name + " carries no multicast", "ip link set " + name + " multicast on; or network.peers");
    }
    return {Rating::Good, "interface", name + " is up and has an address", ""};
}

Finding rate_route(const NetworkConfig& network, const std::expected<void, std::string>& route,
                   std::optional<bool> received) {
    if (!network.peers.empty() && !(route && received.value_or(true))) {
        return {Rating::Good, "multicast",
                "there is no route; network.peers does not need it, but LCM does (or use --no-lcm)", ""};
    }
    if (!route) {
        return {Rating::Bad, "multicast", "the record cannot be published: " + route.error(),
                "ip route add 224.0.0.0/4 dev " + network.interface};
    }
    if (received == false) {
        return {Rating::Bad, "multicast", "messages of LCM to " + network.lcm_url + " are not received",
                "iptables -L INPUT -n; check whether a rule drops it"};
    }
    return {Rating::Good, "multicast", received ? "LCM receives its own messages" : "a route exists", ""};
}

std::optional<std::int64_t> buffer_asked(const std::string& lcm_url) {
    constexpr std::string_view kKey = "recv_buf_size=";
    const std::size_t at = lcm_url.find(kKey);
    if (at == std::string::npos) { return std::nullopt; }
    return if_positive(std::strtoll(lcm_url.c_str() + at + kKey.size(), nullptr, 10));
}

Finding rate_buffer(std::int64_t asked, std::int64_t given) {
    const std::string text = fmt::format("{} of {} bytes", given, asked);
    if (given >= asked) { return {Rating::Good, "socket buffer", text, ""}; }
    return {Rating::Doubtful, "socket buffer", text + ": bursts of the record may be lost",
            fmt::format("sysctl -w net.core.rmem_max={}", asked)};
}

Finding rate_send_buffer(std::int64_t needed, std::int64_t given) {
    const std::string text = fmt::format("{} bytes; {} are needed", given, needed);
    if (given >= needed) { return {Rating::Good, "send buffer", text, ""}; }
    return {Rating::Doubtful, "send buffer",
            text + ": while many of network.peers are absent, this host's parts may fall silent for seconds",
            fmt::format("sysctl -w net.core.wmem_max={}", needed)};
}

Finding rate_states(const MachineSetup& machine, const std::expected<std::string, std::string>& memory) {
    constexpr std::size_t kMany = 16;  // axes; on a host with so many, their states are most of its work
    const std::size_t axes = motor_count(machine);
    const bool shares = machine.network.one_host;
    if (shares && !memory) {
        return {Rating::Bad, "axes' states", memory.error(), "df -h /dev/shm; or leave network.one_host out"};
    }
    if (shares) { return {Rating::Good, "axes' states", "go through " + *memory, ""}; }
    if (machine.network.interface != "lo" || axes < kMany) { return {Rating::Good, "axes' states", "go by DDS", ""}; }
    return {Rating::Doubtful, "axes' states",
            fmt::format("{} axes on one host receive {} states from the network each slot", axes, axes * (axes - 1)),
            "network { one_host: true } in the machine's file"};
}

Finding rate_scheduler(const RealTimeConfig& wanted, const RealTimeFacts& facts) {
    if (facts.scheduler.empty()) {
        const std::string use = wanted.priority > 0 ? "" : "; unused: the machine's file has no real_time.priority";
        return {Rating::Good, "scheduler", "FIFO is permitted" + use, ""};
    }
    const Rating rating = wanted.priority > 0 ? Rating::Bad : Rating::Good;
    return {rating, "scheduler", "FIFO is refused (" + facts.scheduler + "): a busy host stalls the services",
            wanted.priority > 0 ? "LimitRTPRIO=99 in the unit, or ulimit -r 99" : ""};
}

Finding rate_memory(const RealTimeConfig& wanted, const RealTimeFacts& facts) {
    if (facts.memory.empty()) { return {Rating::Good, "memory", "it may be locked", ""}; }
    const Rating rating = wanted.priority > 0 ? Rating::Bad : Rating::Good;
    return {rating, "memory", "it may not be locked (" + facts.memory + "): a page on disk stalls the services",
            wanted.priority > 0 ? "LimitMEMLOCK=infinity in the unit, or ulimit -l unlimited" : ""};
}

ProtocolTiming timing_for(const StallFacts& facts, const ProtocolTiming& today) {
    constexpr std::array<std::int64_t, 6> kSlots_us{1000, 2000, 5000, 10'000, 20'000, 50'000};
    const double stall = 2 * facts.worst_us;
    const auto fits = [&](std::int64_t slot) {
        return slot >= least_slot_us(today) && static_cast<double>(slot) * 10 >= stall;
    };
    const auto slot = std::ranges::find_if(kSlots_us, fits);
    ProtocolTiming timing{.slot_us = slot == kSlots_us.end() ? kSlots_us.back() : *slot,
                          .segment_entries = today.segment_entries,
                          .output_entries = today.output_entries};
    timing.stall_slots = std::max(1, static_cast<int>(std::ceil(stall / static_cast<double>(timing.slot_us))));
    timing.late_check_slots = std::min(timing.late_check_slots, timing.stall_slots);
    return with_least_times(timing);
}

Finding rate_stalls(const ProtocolTiming& timing, const StallFacts& facts) {
    const double may_us = static_cast<double>(timing.stall_slots) * static_cast<double>(timing.slot_us);
    const ProtocolTiming better = timing_for(facts, timing);
    const std::string found = fmt::format(
        "in {} s a thread woke up at most {} late, and in 99 of 100 cases at most {}; the timing allows {}",
        std::lround(facts.seconds), milliseconds(facts.worst_us), milliseconds(facts.p99_us), milliseconds(may_us));
    if (facts.worst_us > may_us) { return {Rating::Bad, "stalls", found, slots_text(better)}; }
    if (2 * facts.worst_us > may_us) { return {Rating::Doubtful, "stalls", found, slots_text(better)}; }
    const auto reaction = [](const ProtocolTiming& t) { return t.slot_us * (t.lease_slots() + t.frame_slots); };
    const bool slack = 2 * reaction(better) < reaction(timing);
    return {Rating::Good, "stalls", found + (slack ? "; a hold could begin sooner with " + slots_text(better) : ""),
            ""};
}

Finding rate_clock(TimeSource source, const ClockFacts& facts) {
    if (source == TimeSource::Ptp && !(facts.synchronised && facts.tai_offset_s)) {
        return {Rating::Bad, "clock",
                std::string("time_source is PTP, but ") +
                    (facts.synchronised ? "CLOCK_TAI is not set" : "no service keeps this host's clock"),
                "apt-get install linuxptp; then ptp4l -i INTERFACE -s and phc2sys -a -r"};
    }
    constexpr std::array<std::string_view, 5> kQuick{"tsc", "kvm-clock", "arch_sys_counter",
                                                     "hyperv_clocksource_tsc_page", ""};
    if (std::ranges::find(kQuick, facts.source) == kQuick.end()) {
        return {Rating::Doubtful, "clock", "the kernel uses the clock " + facts.source + ", which is slow to read",
                "clocksource=tsc on the kernel's command line, if the processor has this clock"};
    }
    return {Rating::Good, "clock", "the kernel uses the clock " + facts.source, ""};
}

Finding rate_device(const MotorConfig& axis, const std::expected<void, std::string>& answer) {
    if (answer) { return {Rating::Good, "device of " + axis.name, axis.device.text(), ""}; }
    return {Rating::Bad, "device of " + axis.name, axis.device.text() + ": " + answer.error(),
            "power it up, or correct `device` of " + std::string(axis.is_board() ? "board " : "axis ") + axis.name +
                " in the machine's file"};
}

Finding rate_board(const BoardLinkConfig& board, const std::vector<std::string>& lacks) {
    const std::string what = "board " + board.name;
    if (lacks.empty()) { return {Rating::Good, what, board.link.text() + " answers, and suits its motors", ""}; }
    return {Rating::Bad, what, fmt::format("{}", fmt::join(lacks, "; ")),
            fmt::format("mend it, then look again: lockstep board check --board {}", board.name)};
}

Finding rate_directory(const std::string& what, const std::string& path, const std::string& not_writable) {
    if (not_writable.empty()) { return {Rating::Good, what, path + " can be written", ""}; }
    return {Rating::Bad, what, path + " cannot be written: " + not_writable, "install -d -o $(id -un) " + path};
}

namespace {

std::string joined(const std::vector<std::string>& hosts) { return fmt::format("{}", fmt::join(hosts, ", ")); }

Finding rate_one_process(const ProcessFacts& facts, std::uint64_t config_hash) {
    if (facts.hosts.size() > 1 && !facts.may_be_two) {
        return {Rating::Bad, facts.name, "runs more than once, on " + joined(facts.hosts),
                "on the host where it does not belong: lockstep down"};
    }
    if (!facts.received) {
        return {Rating::Doubtful, facts.name, "no messages are received", "on its host: lockstep up"};
    }
    if (facts.config_hash != config_hash) {
        return {Rating::Bad, facts.name, "runs with another configuration than this file",
                "give all hosts the same machine file, then: lockstep down; lockstep up"};
    }
    return {Rating::Good, facts.name, "runs with this configuration", ""};
}

}  // namespace

Finding rate_process(const ProcessFacts& facts, std::uint64_t config_hash) {
    Finding finding = rate_one_process(facts, config_hash);
    finding.host = joined(facts.hosts);
    return finding;
}

Finding rate_keys(const KeyFacts& facts) {
    const std::string what = "keys of " + facts.member;
    constexpr const char* kSee = "see: lockstep keys check";
    if (!facts.here) {
        return {Rating::Bad, what, "are not on this host, where it runs", "copy them here; " + std::string(kSee)};
    }
    if (facts.is_out) { return {Rating::Bad, what, facts.trouble, kSee}; }
    if (!facts.trouble.empty()) { return {Rating::Doubtful, what, facts.trouble, kSee}; }
    return {Rating::Good, what, fmt::format("are valid for {} days", facts.days_left), ""};
}

}  // namespace lockstep::doctor
