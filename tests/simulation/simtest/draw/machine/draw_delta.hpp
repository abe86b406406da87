// Deltas: three carriages on towers carry the tool by rods.
#pragma once

#include <cstdint>

#include "core/machine.hpp"

namespace lockstep::simtest {

/// Makes the first three axes of a drawn machine X, Y and Z of a delta: towers in any triangle, rods that lie as flat
/// as the configuration allows or less, switches above or below the carriages, or a homing in place. Machines with
/// fewer axes get more. The random numbers are separate, as in with_motors.
MachineConfig with_delta(std::uint64_t seed, MachineConfig machine);

}  // namespace lockstep::simtest
