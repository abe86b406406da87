// The steps of a move by one of the published methods, one after the other, so that nothing is computed in advance.
#pragma once

#include "core/motion/step_source.hpp"

namespace lockstep::methods {

/// A BeginSteps. It begins the nearest move that the method can make with its paper's settings, so that the move keeps
/// the limits of an axis that the method suits (suits.hpp): spielauer, lai and lam ignore the start speed and start
/// slowly, lai changes its speed by one pulse per period, carrica's least speed is two steps' acceleration below the
/// start speed. Returns an error if the method cannot make the move, and for Ranade's method, which makes pieces and
/// not steps (core/motion/profile.hpp).
std::expected<std::unique_ptr<StepSource>, StepError> begin_steps(StepMethod method, const StepMove& move);

}  // namespace lockstep::methods
