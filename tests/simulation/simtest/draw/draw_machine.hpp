// A machine that the configuration's rules allow, of any size, speed and timing.
#pragma once

#include "core/machine.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {

/// How long a search for a switch over the whole travel takes: after a stuck switch, or a fault far from it.
double search_slots(const AxisConfig& axis, const ProtocolTiming& timing);

/// `long_searches`: of every length there is. Without them none takes more than some thousand slots: about half of the
/// time for as many faults.
MachineConfig draw_machine(Draw& draw, std::size_t axes, bool long_searches);

}  // namespace lockstep::simtest
