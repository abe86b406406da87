// Which part of a machine runs on which host.
#pragma once

#include <cstddef>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

/// Two names of one host: equal but for capitals, or one is the other without its domain.
bool same_host(std::string_view one, std::string_view other);

/// The hosts that a configuration names, each once.
std::vector<std::string> hosts_of(const MachineConfig& machine);

/// The processes of a host: those placed there, and those placed nowhere.
struct Placement {
    bool coordinator = false;
    std::vector<std::size_t> axes;
    bool empty() const { return !coordinator && axes.empty(); }
};
Placement placed_on(const MachineConfig& machine, std::string_view host);

/// The axis that a process on this host runs: the one `named`; if none is named, the only one that is placed there by
/// name. The error lists the axes.
std::expected<std::size_t, std::string> axis_to_run(const MachineConfig& machine, std::string_view named,
                                                    std::string_view host);

}  // namespace lockstep
