// The path in the X-Y plane, as the jobs' programs commanded it and as the axes stepped it.
#pragma once

#include <optional>

#include "clients/analysis/analysis.hpp"
#include "clients/drawing/motion_figures.hpp"

namespace lockstep::analysis {

/// In mm. Stepped contains the steps of the jobs that have a program, or all steps if no job has one; broken where
/// steps are missing.
struct PlanePaths {
    drawing::PlanePath asked;
    drawing::PlanePath stepped;
};

/// None unless there are axes X and Y whose steps per mm are known.
std::optional<PlanePaths> paths_in_plane(const Analysis& analysis);

/// The places a program leads through in the X-Y plane, in mm; none unless it has both axes. Of more than
/// `at_most` places those are left out that a picture does not need.
std::vector<drawing::Point> asked_in_plane(const RecordedProgram& program, std::size_t at_most);

}  // namespace lockstep::analysis
