// Times the legs of a program without frames.
#pragma once

#include <functional>
#include <memory>

#include "clients/planning/plan_totals.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/overrides.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

/// Reads each block once, in order. The program must keep the rules of ProgramPlanner::plan, except that it may end
/// before a block that does not. The machine must not use the LAI method. `progress` may be empty.
PlannedTotals time_legs(const MachineConfig& machine, const std::shared_ptr<const ProgramBlocks>& blocks,
                        const AxisCounts& start, const Overrides& overrides,
                        const std::function<void(Ticks)>& progress);

}  // namespace lockstep
