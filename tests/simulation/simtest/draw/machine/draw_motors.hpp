// Axes with several motors, and axes that share them.
#pragma once

#include <cstdint>

#include "core/machine.hpp"

namespace lockstep::simtest {

/// Gives a drawn machine one or two of: two or three motors on an axis, two belts for two axes, geared and mirrored
/// motors, a skew. The random numbers are separate: machines without motors stay the same.
MachineConfig with_motors(std::uint64_t seed, MachineConfig machine);

}  // namespace lockstep::simtest
