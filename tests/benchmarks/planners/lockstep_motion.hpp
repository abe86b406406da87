// The time and the speed changes of a program as Lockstep plans it.
#pragma once

#include "clients/planning/leg_plan.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"
#include "tests/benchmarks/planners/speed_changes.hpp"

namespace lockstep::planners {

struct LockstepMotion {
    double seconds = 0;
    ChangeShares changes{};
};

/// Error: the planner refuses the program.
std::expected<LockstepMotion, PlanError> lockstep_motion(const MachineConfig& machine, const Program& program);

}  // namespace lockstep::planners
