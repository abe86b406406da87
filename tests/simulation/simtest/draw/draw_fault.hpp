// Faults of processes and links, placed near the instants at which the protocol decides.
#pragma once

#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Draws a fault for a job. Returns nullopt if no kind of fault is requested, and sometimes at random.
std::optional<PlannedFault> draw_fault(Draw& draw, const MachineConfig& machine, const FaultKinds& faults);

/// Draws a fault for a homing.
std::optional<PlannedFault> draw_homing_fault(Draw& draw, const MachineConfig& machine, const FaultKinds& faults);

}  // namespace lockstep::simtest
