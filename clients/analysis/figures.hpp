// The figures of an analysis: `speed.svg`, `position.svg` and `xy.svg`, `outputs.svg` if an input or output changed,
// and `power.svg` if there is a power map.
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <string>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/plane_path.hpp"
#include "clients/drawing/figure.hpp"

namespace lockstep::analysis {

/// Time counts from the log's first step. Lengths are in steps if an axis's steps per mm are not known.
drawing::Figure speed_figure(const Analysis& analysis);
drawing::Figure position_figure(const Analysis& analysis);
/// Levels as bars, values as curves, and the words of programs that switch them.
drawing::Figure outputs_figure(const Analysis& analysis);
/// The path in the X-Y plane, or the positions over time if there is no such plane.
drawing::Figure path_figure(const Analysis& analysis, const std::optional<PlanePaths>& plane);

/// Writes all of them. The error names the file.
std::expected<void, std::string> write_figures(const Analysis& analysis, const std::optional<PlanePaths>& plane,
                                               const std::filesystem::path& directory);

}  // namespace lockstep::analysis
