// The rules of an axis's homing: its speeds, its switch, and the places to which it goes before and behind that.
#pragma once

#include "core/machine.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {

/// Adds the problems of `homing`, unhomed_jog_mm_s and safe_height_mm.
void check_homing(const MachineConfig& machine, const AxisConfig& axis, ProblemList& problems);

}  // namespace lockstep
