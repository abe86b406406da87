// Machines whose axes home by the touch of an input.
#pragma once

#include <cstdint>

#include "core/machine.hpp"

namespace lockstep::simtest {

/// The switches of about half of the axes are inputs, of any device or board. Axes that share motors get such switches
/// together. An axis searches as slowly as the room behind its switch demands. Not for deltas and axes with several
/// motors of their own.
MachineConfig with_touches(std::uint64_t seed, MachineConfig machine);

}  // namespace lockstep::simtest
