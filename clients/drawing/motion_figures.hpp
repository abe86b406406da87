// The figures of a planned or recorded motion: speed and position of each axis over time, and the path in a plane.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/drawing/figure.hpp"

namespace lockstep::drawing {

/// One quantity of one axis over time. time_s and value have the same length. A value that is not finite breaks the
/// curve.
struct AxisCurve {
    std::string axis;
    std::vector<double> time_s;
    std::vector<double> value;
    std::string unit = "mm";      // of length: "mm", "deg" or "steps"
    std::optional<double> limit;  // of speed, in unit/s, in both directions
    std::vector<Span> missing;    // seconds
};

/// A row for each axis: its speed, with its limit dashed.
Figure speed_figure(std::string title, std::string subtitle, const std::vector<AxisCurve>& axes);
/// A row for each axis: its position.
Figure position_figure(std::string title, std::string subtitle, const std::vector<AxisCurve>& axes);

/// The points of a path in a plane. A value that is not finite breaks the path.
struct PlanePath {
    std::vector<double> x;
    std::vector<double> y;
};

/// The names of the plane's axes, and their unit of length.
struct Plane {
    std::string x = "X";
    std::string y = "Y";
    std::string unit = "mm";
};

/// The stepped path, wide and coloured, under the commanded path, thin and dark. Either may be empty.
Figure path_figure(std::string title, std::string subtitle, const Plane& plane, const PlanePath& asked,
                   const PlanePath& stepped);

}  // namespace lockstep::drawing
