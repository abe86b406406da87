// Partitions of DDS: the machine's name keeps machines in one domain apart, and each axis writes in one of its own, so
// that permissions can tell the axes apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lockstep {

/// Where a process writes: "mill/1" for its axis 1, "mill" for all others.
inline std::string partition_of(const std::string& machine, std::optional<std::uint32_t> axis) {
    return axis ? machine + "/" + std::to_string(*axis) : machine;
}

/// Where everybody reads.
inline std::vector<std::string> heard_partitions(const std::string& machine) { return {machine, machine + "/*"}; }

}  // namespace lockstep
