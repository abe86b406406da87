// The state machine with a delay counter as a method for a planned move.
//
// Source: Lam Chee Yuen and Phaklen Ehkan, "Design and Implementation of FPGA Based Bipolar Stepper Motor Controller
// for Linear Slide Application"; lam_controller.hpp.
#pragma once

#include "core/stepgen/lam_controller.hpp"
#include "core/stepgen/method.hpp"

namespace lockstep::stepgen {

/// Start and cruise delays become the shortest whole counts of the clock, not faster than asked, at least two; a start
/// from rest takes `parameters.start_delay`. Acceleration and deceleration are those of the counter, whatever is asked.
/// Step k is where the position is k.
StepResult lam(const StepMove& move, Fit fit, const LamParameters& parameters = {});

}  // namespace lockstep::stepgen
