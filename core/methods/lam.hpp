// The state machine with a delay counter as a method for a planned move.
//
// Source: Lam Chee Yuen and Phaklen Ehkan, "Design and Implementation of FPGA Based Bipolar Stepper Motor Controller
// for Linear Slide Application"; lam_controller.hpp.
#pragma once

#include "core/methods/lam_controller.hpp"
#include "core/methods/method.hpp"

namespace lockstep::methods {

/// The times of pulses, one after the other.
class LamSteps {
public:
    /// Returns the errors of lam().
    static std::expected<LamSteps, StepError> of(const StepMove& move, Fit fit, const LamParameters& parameters = {});

    /// Call it once for each step of the move.
    double next_s();
    double clock_s() const { return clock_s_; }
    const std::string& nearest() const { return nearest_; }

private:
    LamSteps(std::int64_t steps, const LamParameters& made, std::string nearest);

    LamController controller_;
    double clock_s_;
    std::string nearest_;
    std::int64_t now_ = 0;
};

/// Start and cruise delays become the shortest whole counts of the clock that are not faster than requested, at least
/// two. A start from rest uses `parameters.start_delay`. Acceleration and deceleration are always those of the counter.
/// Step k is at position k.
StepResult lam(const StepMove& move, Fit fit, const LamParameters& parameters = {});

}  // namespace lockstep::methods
