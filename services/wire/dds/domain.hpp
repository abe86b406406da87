// A process's DDS domain, with its profile and its sockets on one interface.
//
// The configuration determines the profile, not the environment, so that all processes of a machine have the same one.
// If CYCLONEDDS_URI is set, DDS reads it after the profile. It may add to the profile (tracing) or override it.
#pragma once

#include <chrono>
#include <expected>
#include <memory>
#include <string>

#include "services/setup/machine_setup.hpp"
#include "services/wire/dds/entity.hpp"
#include "services/wire/dds/interface_sockets.hpp"

namespace lockstep {

/// The process's first participant in the domain creates it, and it is deleted after the last. By then DDS has notified
/// all peers that this process leaves. Without that notice, peers would keep contacting it until its lease expires.
class Domain {
public:
    /// To end its receiving threads, DDS sends packets to itself until each thread has received one. On an interface
    /// that is gone no packet arrives, so this shuts the sockets down first.
    ~Domain() { end_reception(sockets_); }
    Domain(const Domain&) = delete;
    Domain& operator=(const Domain&) = delete;

    /// Error: the domain, the interface, DDS's error, and the remedy. It is also an error if this process has that
    /// domain on another interface.
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

/// Returns the Cyclone DDS configuration of a machine's processes, as XML. Error: the interface's name is not valid.
std::expected<std::string, std::string> dds_profile(const NetworkConfig& network,
                                                    Discovery discovery = Discovery::Quiet);

/// How long DDS regards a process that ended without notice as present.
std::chrono::nanoseconds lease_of(const NetworkConfig& network);

/// Returns a text such as "DDS domain 3 on interface eth0".
std::string domain_place(const NetworkConfig& network);
/// Returns the error's text, with the remedy.
std::string cannot_open_domain(const NetworkConfig& network, const char* why);

}  // namespace lockstep
