// Which part of a machine runs on which host.
#pragma once

#include <cstddef>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// Whether both names mean the same host. Upper and lower case do not matter. If one name has no domain, the other's
/// domain does not matter.
bool same_host(std::string_view one, std::string_view other);

/// Returns the hosts that a configuration names, each once.
std::vector<std::string> hosts_of(const MachineSetup& machine);

/// The processes of a host: those placed on it, and those without a host in the configuration.
struct Placement {
    bool coordinator = false;
    std::vector<MotorIndex> axes;  // those that these processes serve
    bool empty() const { return !coordinator && axes.empty(); }
};
Placement placed_on(const MachineSetup& machine, std::string_view host);

/// Returns the axis that a process on this host runs: the axis `named`, or, if `named` is empty, the only axis placed
/// on this host. The error lists the axes.
std::expected<MotorIndex, std::string> axis_to_run(const MachineSetup& machine, std::string_view named,
                                                   std::string_view host);

}  // namespace lockstep
