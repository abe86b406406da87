// The values that outlive programs (coordinate systems, offsets, tool table), as the coordinator publishes them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep {

struct MachineValues {
    Term term;                        // of the coordinator that owns the machine
    std::uint64_t revision = 0;       // increases with every change
    bool on_disk = false;             // the coordinator's file contains this revision
    std::vector<std::uint8_t> bytes;  // Protobuf
    bool operator==(const MachineValues&) const = default;
};

}  // namespace lockstep
