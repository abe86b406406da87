// Faults of an axis's hardware: a switch that is stuck, a slide that is pushed, a device that loses a frame.
#pragma once

#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Draws a fault for a job, or for the time shortly before it.
PlannedFault draw_plant_fault(Draw& draw, const MachineConfig& machine);

/// Draws a fault for a homing.
PlannedFault draw_plant_fault_of_homing(Draw& draw, const MachineConfig& machine);

/// A device dies and is replaced, stops for less or more than its axis tolerates, or has its registers overwritten: in
/// a job, or in a homing.
PlannedFault draw_device_fault(Draw& draw, const MachineConfig& machine);
PlannedFault draw_device_fault_of_homing(Draw& draw, const MachineConfig& machine);

}  // namespace lockstep::simtest
