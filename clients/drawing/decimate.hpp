// Reduces the number of points without changing the picture.
#pragma once

#include <vector>

#include "clients/drawing/svg.hpp"

namespace lockstep::drawing {

/// For a curve whose x never falls: of each pixel column the first, lowest, highest and last point, in their order.
/// A line through them paints the same pixels as a line through all. Source: Jugel et al., M4, VLDB 2014.
std::vector<Point> decimate_columns(const std::vector<Point>& points);

/// For any path: leaves out points while a straight line from the last one kept passes each within `tolerance`
/// pixels. A reversal on the same line is kept. One pass. Source: Zhao and Saalfeld, sleeve fitting, 1997.
std::vector<Point> decimate_path(const std::vector<Point>& points, double tolerance);

}  // namespace lockstep::drawing
