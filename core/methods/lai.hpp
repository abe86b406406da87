// Velocity planner and hardware DDA as a method for one axis.
//
// Source: Lai, Chien, Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives Design": every
// 6.5 ms a whole number of pulses (lai_planner.hpp), spread evenly by a DDA (lai_dda.hpp).
#pragma once

#include "core/methods/lai_dda.hpp"
#include "core/methods/lai_planner.hpp"
#include "core/methods/method.hpp"

namespace lockstep::methods {

struct LaiParameters {
    double period_s = 6.5e-3;  // the sampling time of Section 3.1
};

/// The times of pulses, one after the other.
class LaiSteps {
public:
    /// Returns the errors of lai().
    static std::expected<LaiSteps, StepError> of(const StepMove& move, Fit fit, const LaiParameters& parameters = {});

    /// Call it once for each step of the move.
    double next_s();
    double clock_s() const { return clock_s_; }
    const std::string& nearest() const { return nearest_; }

private:
    LaiSteps(std::int64_t steps, const LaiSpeeds& speeds, double clock_s, std::string nearest);

    LaiLongAxis axis_;
    Dda dda_;
    double clock_s_;  // of the DDA
    std::string nearest_;
    std::int64_t now_ = 0;
};

/// Speeds become whole pulses per period, not above the requested ones. Acceleration and deceleration become the same
/// whole number of pulses per period^2, at least one (23,669 steps/s^2). Step k is at position k. Returns an error if
/// the maximum is below one pulse per period, or does not fit in the DDA's register.
StepResult lai(const StepMove& move, Fit fit, const LaiParameters& parameters = {});

}  // namespace lockstep::methods
