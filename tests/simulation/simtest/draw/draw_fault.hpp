// Faults of processes and links, drawn where they hurt: about the instants at which the protocol decides.
#pragma once

#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// For a job; nothing where no kind of it is asked for, and now and then.
std::optional<PlannedFault> draw_fault(Draw& draw, const MachineConfig& machine, const FaultKinds& faults);

/// For a homing.
std::optional<PlannedFault> draw_homing_fault(Draw& draw, const MachineConfig& machine, const FaultKinds& faults);

}  // namespace lockstep::simtest
