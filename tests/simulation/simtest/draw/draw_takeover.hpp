// Faults about who owns a machine of two coordinators: what silences the owner, and what then goes wrong in the
// takeover.
#pragma once

#include <vector>

#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// For a job, in the order in which they are placed.
std::vector<PlannedFault> draw_takeover(Draw& draw, const MachineConfig& machine);

/// For a homing.
std::vector<PlannedFault> draw_takeover_of_homing(Draw& draw, const MachineConfig& machine);

/// Now and then the network finds who was frozen only about when those that it does not hear would count as lost.
void draw_late_network(Draw& draw, const MachineConfig& machine, std::vector<PlannedFault>& planned);

}  // namespace lockstep::simtest
