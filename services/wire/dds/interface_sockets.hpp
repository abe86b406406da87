// Cyclone DDS sends by the configured interface alone, but receives on sockets that are bound to every address of the
// host. The kernel is told what DDS has no setting for: whatever comes by another interface is not for these sockets.
#pragma once

#include <expected>
#include <set>
#include <string>

namespace lockstep {

using Descriptors = std::set<int>;

/// The UDP sockets that this process has open now.
Descriptors udp_sockets();

/// Ties those that are open now and were not in `before` to an interface. Error: the kernel refuses, and why.
std::expected<void, std::string> tie_new_sockets(const Descriptors& before, const std::string& interface);

/// Makes whoever waits for a packet on them return without one, now and from now on.
void end_reception(const Descriptors& sockets);

}  // namespace lockstep
