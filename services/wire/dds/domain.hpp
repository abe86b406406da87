// A process's DDS domain: its profile, and its sockets on one interface.
//
// The profile is built from the configuration, not read from the environment, so that every process of a machine has
// the same. Where CYCLONEDDS_URI is set it is read after ours: it may add to it (tracing) or override it.
#pragma once

#include <chrono>
#include <expected>
#include <memory>
#include <string>

#include "core/machine.hpp"
#include "services/wire/dds/entity.hpp"
#include "services/wire/dds/interface_sockets.hpp"

namespace lockstep {

/// Made by the process's first participant in it, and gone with the last: by then all others have been told that this
/// process leaves. One that ends without telling them is called on until they take it for gone.
class Domain {
public:
    /// DDS ends its receiving threads by sending packets to itself, again and again until each has come. On an
    /// interface that is gone none does, so the sockets are shut first.
    ~Domain() { end_reception(sockets_); }
    Domain(const Domain&) = delete;
    Domain& operator=(const Domain&) = delete;

    /// Error: the domain, the interface, what DDS said, and the remedy; also where this process has that domain on
    /// another interface.
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

/// Whether DDS tells who comes and goes (dds_log.hpp).
enum class Discovery { Quiet, Traced };

/// The Cyclone DDS configuration of a machine's processes, as XML. Error: the interface's name is none.
std::expected<std::string, std::string> dds_profile(const NetworkConfig& network, Discovery told = Discovery::Quiet);

/// How long DDS takes a process for present that has ended without a word.
std::chrono::nanoseconds lease_of(const NetworkConfig& network);

/// "DDS domain 3 on interface eth0"
std::string domain_place(const NetworkConfig& network);
/// With the remedy.
std::string cannot_open_domain(const NetworkConfig& network, const char* why);

}  // namespace lockstep
