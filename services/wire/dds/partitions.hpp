// Partitions of DDS: the machine's name separates machines in one domain, the protocol's number separates incompatible
// versions, and each axis writes in its own, so that permissions can distinguish the
// axes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dds/dds.h>

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

/// Where a writer or reader with these settings is. Empty: in none, or in several.
inline std::string only_partition(const dds_qos_t* qos) {
    std::uint32_t count = 0;
    char** names = nullptr;
    if (!dds_qget_partition(qos, &count, &names)) { return ""; }
    std::string name = count == 1 ? names[0] : "";
    for (std::uint32_t i = 0; i < count; ++i) { dds_free(names[i]); }
    dds_free(static_cast<void*>(names));
    return name;
}

}  // namespace lockstep
