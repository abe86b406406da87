// A machine's file: the machine, and how its processes run: on which network, with which keys, logs and rights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/device/link_name.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// A board that carries the devices of several motors, which it executes by itself: a motor whose device is
/// "board:NAME/N" has one of them. The board itself takes part in no frame; its motors do.
struct BoardLinkConfig {
    std::string name;
    LinkName link;
    bool operator==(const BoardLinkConfig&) const = default;
};

struct NetworkConfig {
    std::string interface = "lo";
    std::uint32_t domain = 0;
    std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";
    std::vector<std::string> peers;  // hosts that discovery asks, without multicast; none: it multicasts
    std::size_t processes = 0;       // their number; with more, each sends discovery and repair messages less often
    bool one_host = false;           // states of axes go through shared memory, and only seldom over the network
};

/// The flight recorder: keeps the latest notes of each process for the analysis of a fault.
struct FlightConfig {
    bool kept = true;
    std::int64_t memory_kb = 1024;
    int files = 20;  // kept for each process
    bool operator==(const FlightConfig&) const = default;
};

/// The logs that the axes and the coordinator write themselves, each on its own board.
struct RecordConfig {
    bool own_logs = true;
    std::string directory;  // empty: the host's default directory
    std::int64_t size_limit_mb = 256;
    FlightConfig flight;
    bool operator==(const RecordConfig&) const = default;
};

/// Whether the machine's processes authenticate each other.
struct SecurityConfig {
    std::string directory;  // of certificates, keys and permissions; empty: no authentication
    bool enabled() const { return !directory.empty(); }
    bool operator==(const SecurityConfig&) const = default;
};

/// The requests of the machine's processes to their host's scheduler.
struct RealTimeConfig {
    int priority = 0;       // under SCHED_FIFO, with memory locked and touched beforehand; 0: no request
    std::vector<int> cpus;  // processors that the processes may use; empty: all
    bool operator==(const RealTimeConfig&) const = default;
};

/// The web page to operate the machine (lockstep-web). Nothing in motion depends on it.
struct WebConfig {
    std::string address = "127.0.0.1";  // of the listening socket; other hosts can connect only with a certificate
    int port = 2302;
    std::string certificate_file;  // PEM; empty: no TLS
    std::string key_file;
    std::vector<std::string> host_names;  // accepted in URLs, besides the address and this host's own name
    bool operator==(const WebConfig&) const = default;
};

/// A machine as core knows it, and the settings of its processes, which core does not know.
struct MachineSetup : MachineConfig {
    NetworkConfig network;
    SecurityConfig security;
    RecordConfig record;
    RealTimeConfig real_time;
    std::string position_directory;    // where axes store their positions; empty: the host's default
    std::string coordinator_host;      // on which it runs; empty: any host
    std::string subroutine_directory;  // searched after the program's own; empty: only that
    std::optional<WebConfig> web;      // none: `lockstep up` starts no page
    std::vector<BoardLinkConfig> board_links;
};

}  // namespace lockstep
