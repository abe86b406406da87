// The path in the X-Y plane, as the jobs' programs commanded it and as the axes stepped it.
#pragma once

#include <optional>

#include "clients/analysis/analysis.hpp"
#include "clients/drawing/motion_figures.hpp"

namespace lockstep::analysis {

/// In mm. `stepped` contains the steps of the jobs that have a program, or all steps if no job has one. It is broken
/// where steps are missing.
struct PlanePaths {
    drawing::PlanePath asked;
    drawing::PlanePath stepped;
};

/// Returns nullopt unless there are axes X and Y with known steps per mm.
std::optional<PlanePaths> paths_in_plane(const Analysis& analysis);

/// The points of a program's path in the X-Y plane, in mm; empty unless the program has both axes. If there are more
/// than `at_most`, leaves out those that a picture does not need.
std::vector<drawing::Point> asked_in_plane(const RecordedProgram& program, std::size_t at_most);

}  // namespace lockstep::analysis
