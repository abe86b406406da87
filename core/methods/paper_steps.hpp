// The steps of a move by one of the published methods, one after the other: a train of any length costs nothing ahead.
#pragma once

#include "core/motion/step_source.hpp"

namespace lockstep::methods {

/// A BeginSteps. The nearest that the method makes of the move as its paper has it, so that it keeps limits that suit
/// it (suits.hpp): spielauer, lai and lam start slowly whatever the start speed, lai changes its speed by one pulse per
/// period, carrica's least speed lies two steps' acceleration below the start speed. Error: the method cannot make the
/// move, or is Ranade's, whose moves are pieces and not steps (core/motion/profile.hpp).
std::expected<std::unique_ptr<StepSource>, StepError> begin_steps(StepMethod method, const StepMove& move);

}  // namespace lockstep::methods
