// The add-only engine: each tick adds the speed to the position, and makes a pulse when that has grown by a step.
//
// Source: Pramod Ranade, "Linear motor control without the math", EE Times, 2009: the cumulative addition after Table 1
// and the planning of triangular and trapezoidal moves before it. A tick is 1 us, as there.
// It uses the engine and the planner of the product (core/step, core/motion/profile.hpp): additions of the second
// order, and step k at position k - 1/2 instead of the paper's k, so that rounding cannot lose the last step.
// tests/papers/ranade shows that the same engine gives the paper's convention too.
#pragma once

#include "core/methods/method.hpp"
#include "core/step/segment.hpp"

namespace lockstep::methods {

struct RanadeParameters {
    double tick_s = 1e-6;
};

/// The pieces that the engine executes, from rest on a whole step. Returns the errors of ranade().
std::expected<std::vector<Piece>, StepError> ranade_pieces(const StepMove& move,
                                                           const RanadeParameters& parameters = {});

/// Expresses every move. Returns an error if it is faster than one step per two ticks.
StepResult ranade(const StepMove& move, Fit fit, const RanadeParameters& parameters = {});

}  // namespace lockstep::methods
