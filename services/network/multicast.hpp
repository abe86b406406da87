// Keeps LCM's multicast on the configured interface. LCM uses the interface that the routing table gives, and a host's
// default route may lead to any network. (DDS does not need this: it is bound to its interface by name.)
//
// A datagram with ttl 0 never leaves the host, for any route. With a larger ttl it follows the route. So the route must
// then lead to the configured interface, otherwise nothing is published. Without a route the kernel refuses to send.
#pragma once

#include <expected>
#include <string>

#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// Checks that LCM may publish with this configuration. Error: why not, and the remedy.
std::expected<void, std::string> check_multicast(const NetworkConfig& network);

/// Whether LCM needs a route of multicast to lo: on a machine of one host, or if LCM's datagrams stay on their host
/// (ttl 0) and the host has no route for them, as a board without a default route.
bool needs_loopback_multicast(const NetworkConfig& network);

/// Routes multicast to lo. Adds the route if it is missing, which requires root. Returns
/// true if it was added, false if it existed. Error: what failed, and the remedy.
std::expected<bool, std::string> ensure_loopback_multicast();

}  // namespace lockstep
