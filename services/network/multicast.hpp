// Keeps LCM's multicast on the configured interface. LCM leaves the choice of the interface to the routing table,
// and a host's default route may lead anywhere. (DDS does not need this: it is bound to its interface by name.)
//
// The rule: a datagram with ttl 0 never leaves the host, whatever the route. With a larger ttl it follows the route, so
// the route must lead to the configured interface; otherwise nothing is published. Without any route the kernel
// refuses to send.
#pragma once

#include <expected>
#include <string>

#include "core/machine.hpp"

namespace lockstep {

/// Whether LCM may publish under this configuration. Error: why not, and the remedy.
std::expected<void, std::string> check_multicast(const NetworkConfig& network);

/// Routes multicast to lo, for a machine on one host: adds the route if it is missing, which requires root. True: it
/// was added; false: it existed. Error: what failed and the remedy.
std::expected<bool, std::string> ensure_loopback_multicast();

/// Removes the route that ensure_loopback_multicast added.
std::expected<void, std::string> remove_loopback_multicast();

}  // namespace lockstep
