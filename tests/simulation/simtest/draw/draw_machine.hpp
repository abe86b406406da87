// A machine of any size, speed and timing that the configuration rules allow.
#pragma once

#include "core/machine.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {

/// The duration of a switch search over the whole travel: after a stuck switch, or after a fault far from the switch.
double search_slots(const AxisConfig& axis, const ProtocolTiming& timing);

/// `long_searches`: searches of all durations. Without it none takes more than some thousand slots, which halves the
/// time for the same number of faults.
MachineConfig draw_machine(Draw& draw, std::size_t axes, bool long_searches);

}  // namespace lockstep::simtest
