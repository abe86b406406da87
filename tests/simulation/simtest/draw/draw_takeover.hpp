// Faults of the ownership of a machine with two coordinators: what makes the owner silent, and the faults in the
// takeover that follows.
#pragma once

#include <vector>

#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Draws faults for a job, in the order in which they are placed.
std::vector<PlannedFault> draw_takeover(Draw& draw, const MachineConfig& machine);

/// Draws faults for a homing.
std::vector<PlannedFault> draw_takeover_of_homing(Draw& draw, const MachineConfig& machine);

/// Sometimes adds a cut. The network then finds a frozen process only when that process is about to count its silent
/// peers as lost.
void draw_late_network(Draw& draw, const MachineConfig& machine, std::vector<PlannedFault>& planned);

}  // namespace lockstep::simtest
