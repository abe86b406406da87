// The path in the X-Y plane, as the jobs' programs asked for it and as the axes stepped it.
#pragma once

#include <optional>

#include "clients/analysis/analysis.hpp"
#include "clients/drawing/motion_figures.hpp"

namespace lockstep::analysis {

/// In mm. Stepped is what was stepped during the jobs that have a program, or ever, where no job has one; parted where
/// steps are missing.
struct PlaneComparison {
    drawing::PlanePath asked;
    drawing::PlanePath stepped;
    std::optional<double> largest_distance_mm;  // from any point stepped to the nearest point asked; both must exist
};

/// None unless there are axes X and Y whose steps per mm are known.
std::optional<PlaneComparison> compare_in_plane(const Analysis& analysis);

}  // namespace lockstep::analysis
