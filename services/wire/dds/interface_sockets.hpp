// Cyclone DDS sends only on the configured interface, but receives on sockets that are bound to every address of the
// host, and has no setting for that. The kernel is told to deliver only packets of that interface to these sockets.
#pragma once

#include <expected>
#include <set>
#include <string>

namespace lockstep {

using Descriptors = std::set<int>;

/// The UDP sockets that this process has open now.
Descriptors udp_sockets();

/// Binds those that are open now and were not in `before` to an interface. Error: the kernel refuses, and why.
std::expected<void, std::string> tie_new_sockets(const Descriptors& before, const std::string& interface);

/// Every thread that waits for a packet on them returns without one, now and from now on.
void end_reception(const Descriptors& sockets);

}  // namespace lockstep
