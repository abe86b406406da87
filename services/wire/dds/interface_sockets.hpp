// Binds DDS's sockets to one interface. Cyclone DDS sends only on the configured interface, but receives on sockets
// bound to every address of the host, and has no setting to change that. After the binding the kernel delivers only
// packets of that interface to these sockets.
#pragma once

#include <expected>
#include <set>
#include <string>

namespace lockstep {

using Descriptors = std::set<int>;

/// The UDP sockets that this process has open now.
Descriptors udp_sockets();

/// Binds the sockets that are open now but were not in `before` to an interface. Error: why the kernel refuses.
std::expected<void, std::string> tie_new_sockets(const Descriptors& before, const std::string& interface);

/// Ends reception: every receive call on these sockets returns without a packet from now on, including those that wait
/// now.
void end_reception(const Descriptors& sockets);

}  // namespace lockstep
