// Whether a network interface is still the one that sockets were opened on: one that was unplugged and comes back has
// its name, but sockets that are tied to the old one receive nothing; and DDS tells its peers the address that it had.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lockstep {

struct InterfaceIdentity {
    unsigned index = 0;         // the kernel's
    std::uint32_t address = 0;  // IPv4, in network order
    bool operator==(const InterfaceIdentity&) const = default;
};

/// Nothing: there is none of this name, it is down, or it has no IPv4 address.
std::optional<InterfaceIdentity> interface_identity(const std::string& name);

}  // namespace lockstep
