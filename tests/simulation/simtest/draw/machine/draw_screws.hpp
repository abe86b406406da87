// Machines whose screws have measured errors.
#pragma once

#include <cstdint>

#include "core/machine.hpp"

namespace lockstep::simtest {

/// About two thirds of the motors get a screw, up to as steep and as bent as the rules of configurations allow. Not for
/// deltas.
MachineConfig with_screws(std::uint64_t seed, MachineConfig machine);

}  // namespace lockstep::simtest
