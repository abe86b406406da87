// A process's DDS domain: its profile, and its sockets on one interface.
//
// The profile is built from the configuration, not read from the environment, so that every process of a machine has
// the same. Where CYCLONEDDS_URI is set it is read after ours: it may add to it (tracing) or override it.
#pragma once

#include <expected>
#include <memory>
#include <string>

#include "core/machine.hpp"
#include "services/wire/entity.hpp"

namespace lockstep {

/// Made by the process's first participant in it, and gone with the last: by then all others have been told that this
/// process leaves. One that ends without telling them is called on until they take it for gone.
class Domain {
public:
    /// Error: the domain, the interface, what DDS said, and the remedy; also where this process has that domain on
    /// another interface.
    static std::expected<std::shared_ptr<const Domain>, std::string> join(const NetworkConfig& network,
                                                                          bool is_secured);

private:
    Domain(std::string interface, Entity entity) : interface_(std::move(interface)), entity_(std::move(entity)) {}

    static std::expected<std::shared_ptr<const Domain>, std::string> make(const NetworkConfig& network,
                                                                          bool is_secured);

    std::string interface_;
    Entity entity_;
};

/// Whether DDS tells who comes and goes (dds_log.hpp).
enum class Discovery { Quiet, Traced };

/// The Cyclone DDS configuration of a machine's processes, as XML. Error: the interface's name is none.
std::expected<std::string, std::string> dds_profile(const NetworkConfig& network, Discovery told = Discovery::Quiet);

/// "DDS domain 3 on interface eth0"
std::string domain_place(const NetworkConfig& network);
/// With the remedy.
std::string cannot_open_domain(const NetworkConfig& network, const char* why);

}  // namespace lockstep
