// The rules of kinematics.delta.
#pragma once

#include "core/machine.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {

inline constexpr double kMaxSwitchOffset_mm = 50;  // of a carriage

/// Whether the motor moves a carriage.
bool is_on_tower(const MachineConfig& machine, const std::string& motor);

/// Adds the problems of the machine's delta, if it has one.
void check_delta(const MachineConfig& machine, ProblemList& problems);

}  // namespace lockstep
