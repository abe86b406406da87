// Machines whose motors have backlash.
#pragma once

#include <cstdint>

#include "core/machine.hpp"

namespace lockstep::simtest {

/// Most of the motors that may have one get a play, up to what the rules of configurations allow: those that home to
/// their own switches, in machines without screws and without a delta.
MachineConfig with_backlash(std::uint64_t seed, MachineConfig machine);

}  // namespace lockstep::simtest
