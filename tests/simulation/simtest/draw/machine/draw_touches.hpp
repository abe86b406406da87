// Machines whose axes home by the touch of an input.
#pragma once

#include <cstdint>

#include "core/machine.hpp"

namespace lockstep::simtest {

/// The switches of about half of the axes are inputs, of any device or board. Axes that share motors get such switches
/// together. An axis searches as slowly as the room behind its switch demands. Not for deltas and axes with several
/// motors of their own.
MachineConfig with_touches(std::uint64_t seed, MachineConfig machine);

/// The zero of such an axis may be off by the way in the errors of two clocks and while the contact bounces. Its limit
/// switches are farther behind its travel by that. Call it when the clocks and contacts are drawn.
void put_limits_behind_errors(MachineConfig& machine);

}  // namespace lockstep::simtest
