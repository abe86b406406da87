// A machine of any size, speed and timing that the configuration rules allow.
#pragma once

#include "core/machine.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {

/// The slots of a switch search over the whole travel, as after a stuck switch or after a fault far from the switch.
double search_slots(const AxisConfig& axis, const ProtocolTiming& timing);

/// With `long_searches` a search may last any time. Without it none takes more than 4,000 slots, which halves the time
/// for the same number of faults.
MachineConfig draw_machine(Draw& draw, std::size_t axes, bool long_searches);

}  // namespace lockstep::simtest
