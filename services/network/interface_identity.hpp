// Detects that a network interface was replaced since its sockets were opened. An interface that was unplugged and
// plugged in again keeps its name. But sockets bound to the old one receive nothing, and DDS announces the old address.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lockstep {

struct InterfaceIdentity {
    unsigned index = 0;         // the kernel's index
    std::uint32_t address = 0;  // IPv4, in network order
    bool operator==(const InterfaceIdentity&) const = default;
};

/// Returns nullopt if no interface has this name, it is down, or it has no IPv4 address.
std::optional<InterfaceIdentity> interface_identity(const std::string& name);

}  // namespace lockstep
