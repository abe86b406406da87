// Partitions of DDS: the machine's name separates machines in one domain, the protocol's number separates incompatible
// versions, and each axis writes in its own, so that permissions can distinguish the
// axes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/wire/dds/protocol_version.hpp"

namespace lockstep {

/// Where all processes but the axes write, such as "mill@2".
inline std::string partition_of(const std::string& machine) { return machine + "@" + std::to_string(kProtocol); }

/// Where a process writes: "mill@2/0" for its axis 0.
inline std::string partition_of(const std::string& machine, std::optional<std::uint32_t> axis) {
    return partition_of(machine) + (axis ? "/" + std::to_string(*axis) : "");
}

/// Where all processes read.
inline std::vector<std::string> read_partitions(const std::string& machine) {
    return {partition_of(machine), partition_of(machine) + "/*"};
}

}  // namespace lockstep
