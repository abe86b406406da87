// The rules of an axis that homes by the touch of an input.
#pragma once

#include "core/machine.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {

/// How far the axis goes on behind the touch is bounded here, before anything moves. An axis without such an input has
/// no problem.
void check_homing_input(const MachineConfig& machine, const AxisConfig& axis, ProblemList& problems);

}  // namespace lockstep
