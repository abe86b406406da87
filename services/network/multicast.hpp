// Keeps LCM's multicast where the configuration says. LCM leaves the choice of the interface to the routing table,
// and a machine's default route may lead anywhere. (DDS does not need this: it is bound to its interface by name.)
//
// The rule: a datagram with ttl 0 never leaves the host, whatever the route; with a larger ttl it goes where the route
// says, so the route must be that of the configured interface, or nothing is published. With no route at all the
// kernel refuses to send.
#pragma once

#include <expected>
#include <string>

#include "core/machine.hpp"

namespace lockstep {

/// Whether LCM may publish under this configuration. Error: why not, and the remedy.
std::expected<void, std::string> check_multicast(const NetworkConfig& network);

/// Routes multicast to lo, for a machine that is whole on one host: adds the route where it is missing, which takes
/// root. True: it was added; false: it was there. Error: what failed and the remedy.
std::expected<bool, std::string> ensure_loopback_multicast();

/// Takes back what ensure_loopback_multicast added.
std::expected<void, std::string> remove_loopback_multicast();

}  // namespace lockstep
