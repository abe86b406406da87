// What outlives programs, as the coordinator publishes it: coordinate systems, offsets and the tool table.
#pragma once

#include <cstdint>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep {

struct MachineValues {
    Term term;                        // of the coordinator that owns the machine
    std::uint64_t revision = 0;       // increases with every change
    std::uint64_t kept = 0;           // the revision that is on the coordinator's disk
    std::vector<std::uint8_t> bytes;  // Protobuf
    bool operator==(const MachineValues&) const = default;
};

}  // namespace lockstep
