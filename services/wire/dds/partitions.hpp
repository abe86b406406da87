// Partitions of DDS: the machine's name keeps machines in one domain apart, the protocol's number keeps versions apart
// that would misunderstand each other, and each axis writes in one of its own, so that permissions can tell the axes
// apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/wire/dds/protocol_version.hpp"

namespace lockstep {

/// Where all but the axes write, such as "mill@2".
inline std::string partition_of(const std::string& machine) { return machine + "@" + std::to_string(kProtocol); }

/// Where a process writes: "mill@2/0" for its axis 0.
inline std::string partition_of(const std::string& machine, std::optional<std::uint32_t> axis) {
    return partition_of(machine) + (axis ? "/" + std::to_string(*axis) : "");
}

/// Where everybody reads.
inline std::vector<std::string> heard_partitions(const std::string& machine) {
    return {partition_of(machine), partition_of(machine) + "/*"};
}

}  // namespace lockstep
