// A process's DDS domain: its profile, and its sockets on one interface.
//
// The profile is built from the configuration, not read from the environment, so that every process of a machine has
// the same. CYCLONEDDS_URI, if set, is read after it, and may add to it (tracing) or override it.
#pragma once

#include <chrono>
#include <expected>
#include <memory>
#include <string>

#include "core/machine.hpp"
#include "services/wire/dds/entity.hpp"
#include "services/wire/dds/interface_sockets.hpp"

namespace lockstep {

/// Created by the process's first participant in it, and deleted with the last: by then all peers have been notified
/// that this process leaves. Without that notice, peers keep contacting it until its lease expires.
class Domain {
public:
    /// DDS ends its receiving threads by sending packets to itself, repeatedly until each has arrived. On an interface
    /// that is gone none arrives, so the sockets are shut down first.
    ~Domain() { end_reception(sockets_); }
    Domain(const Domain&) = delete;
    Domain& operator=(const Domain&) = delete;

    /// Error: the domain, the interface, DDS's error, and the remedy; also if this process has that domain on another
    /// interface.
    static std::expected<std::shared_ptr<const Domain>, std::string> join(const NetworkConfig& network,
                                                                          bool is_secured);

private:
    Domain(std::string interface, Entity entity, Descriptors sockets)
        : interface_(std::move(interface)), entity_(std::move(entity)), sockets_(std::move(sockets)) {}

    static std::expected<std::shared_ptr<const Domain>, std::string> make(const NetworkConfig& network,
                                                                          bool is_secured);

    std::string interface_;
    Entity entity_;
    Descriptors sockets_;
};

/// Whether DDS traces joining and leaving participants (dds_log.hpp).
enum class Discovery { Quiet, Traced };

/// The Cyclone DDS configuration of a machine's processes, as XML. Error: the interface's name is not valid.
std::expected<std::string, std::string> dds_profile(const NetworkConfig& network,
                                                    Discovery discovery = Discovery::Quiet);

/// How long DDS regards a process as present that ended without notice.
std::chrono::nanoseconds lease_of(const NetworkConfig& network);

/// "DDS domain 3 on interface eth0"
std::string domain_place(const NetworkConfig& network);
/// With the remedy.
std::string cannot_open_domain(const NetworkConfig& network, const char* why);

}  // namespace lockstep
