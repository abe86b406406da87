// Plans the legs of a program by Lai's method, move by move, without frames. Each move goes from rest to rest, so no
// other one need be in memory. The cost depends on the moves and not on their duration.
#pragma once

#include <expected>
#include <functional>
#include <memory>

#include "clients/planning/plan_totals.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

/// Reads each block once, in order. The figures are those of the frames. `progress` may be empty. Fails like
/// ProgramPlanner::plan.
std::expected<PlannedTotals, PlanError> plan_lai_legs(const MachineConfig& machine,
                                                      const std::shared_ptr<const ProgramBlocks>& blocks,
                                                      const AxisCounts& start,
                                                      const std::function<void(Ticks)>& progress);

}  // namespace lockstep
