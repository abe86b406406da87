// The add-only engine: each tick the speed is added to the position, and where that has grown by a step, a pulse.
//
// Source: Pramod Ranade, "Linear motor control without the math", EE Times, 2009: the cumulative addition after Table 1
// and the planning of triangular and trapezoidal moves before it. A tick is 1 us, as there.
// This is the engine and the planner that the product runs (core/step, core/motion/profile.hpp): additions of the
// second order, and step k where the position is k - 1/2 instead of the paper's k, so that rounding cannot lose the
// last step. That the paper's own convention comes out of the same engine is tests/papers/ranade.
#pragma once

#include "core/methods/method.hpp"

namespace lockstep::methods {

struct RanadeParameters {
    double tick_s = 1e-6;
};

/// Expresses every move. Error: faster than one step per two ticks.
StepResult ranade(const StepMove& move, Fit fit, const RanadeParameters& parameters = {});

}  // namespace lockstep::methods
