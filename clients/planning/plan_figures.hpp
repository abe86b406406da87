// The figures of a plan: the path in the plane of its first two axes, and each axis's planned speed.
#pragma once

#include "clients/drawing/figure.hpp"
#include "clients/planning/leg_plan.hpp"
#include "clients/planning/plan_summary.hpp"

namespace lockstep {

/// Axes X and Y if the machine has them, else its first two; for a single axis, that over itself.
drawing::Figure plan_path_figure(const MachineConfig& machine, const ProgramPlan& plan,
                                 const std::vector<LegPlan>& legs);

/// Paths follow each other without the pauses between them.
drawing::Figure plan_speed_figure(const MachineConfig& machine, const ProgramPlan& plan,
                                  const std::vector<LegPlan>& legs);

}  // namespace lockstep
