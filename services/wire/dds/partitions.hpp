// Partitions of DDS. The machine's name in a partition separates machines in one domain, and the protocol's number
// separates incompatible versions. Each axis writes in its own partition, so that permissions can distinguish the axes.
// Also reads what the peers announce in their settings.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dds/dds.h>

#include "services/wire/dds/protocol_version.hpp"

namespace lockstep {

/// The partition in which all processes except the axes write, such as "mill@2".
inline std::string partition_of(const std::string& machine) { return machine + "@" + std::to_string(kProtocol); }

/// The partition in which a process writes, such as "mill@2/0" for axis 0.
inline std::string partition_of(const std::string& machine, std::optional<std::uint32_t> axis) {
    return partition_of(machine) + (axis ? "/" + std::to_string(*axis) : "");
}

/// The partitions that all processes read.
inline std::vector<std::string> read_partitions(const std::string& machine) {
    return {partition_of(machine), partition_of(machine) + "/*"};
}

/// Returns the partition of a writer or reader with these settings; empty if it is in none or in several.
inline std::string only_partition(const dds_qos_t* qos) {
    std::uint32_t count = 0;
    char** names = nullptr;
    if (!dds_qget_partition(qos, &count, &names)) { return ""; }
    std::string name = count == 1 ? names[0] : "";
    for (std::uint32_t i = 0; i < count; ++i) { dds_free(names[i]); }
    dds_free(static_cast<void*>(names));
    return name;
}

/// Returns the text that a participant, writer or reader with these settings announces; empty if there is none.
inline std::string user_data(const dds_qos_t* qos) {
    void* data = nullptr;
    std::size_t size = 0;
    if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) { return ""; }
    std::string text(static_cast<const char*>(data), size);
    dds_free(data);
    return text;
}

}  // namespace lockstep
