// Velocity planner and hardware DDA as a method for one axis.
//
// Source: Lai, Chien, Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives Design": every
// 6.5 ms a whole number of pulses (lai_planner.hpp), spread evenly by a DDA (lai_dda.hpp).
#pragma once

#include "core/stepgen/lai_planner.hpp"
#include "core/stepgen/method.hpp"

namespace lockstep::stepgen {

struct LaiParameters {
    double period_s = 6.5e-3;  // the sampling time of Section 3.1
};

/// Speeds become whole pulses per period, not above those asked; the acceleration a whole number of pulses per period
/// and period, at least one (23,669 steps/s^2), both ways. Step k is where the position is k. Error: the maximum is
/// below one pulse per period, or above what the DDA's register holds.
StepResult lai(const StepMove& move, Fit fit, const LaiParameters& parameters = {});

}  // namespace lockstep::stepgen
