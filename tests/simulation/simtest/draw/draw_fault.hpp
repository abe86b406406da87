// Faults of processes and links, placed near the instants at which the protocol decides.
#pragma once

#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// For a job. No result: no kind of fault is requested, or sometimes at random.
std::optional<PlannedFault> draw_fault(Draw& draw, const MachineConfig& machine, const FaultKinds& faults);

/// For a homing.
std::optional<PlannedFault> draw_homing_fault(Draw& draw, const MachineConfig& machine, const FaultKinds& faults);

}  // namespace lockstep::simtest
