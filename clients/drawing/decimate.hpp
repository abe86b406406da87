// Reduces the number of points without changing the picture.
#pragma once

#include <vector>

#include "clients/drawing/svg.hpp"

namespace lockstep::drawing {

/// For a curve with an x that never falls. Keeps the first, lowest, highest and last point of each pixel column, in
/// their order. A line through these paints the same pixels as a line through all. Source: Jugel et al., M4, VLDB 2014.
std::vector<Point> decimate_columns(const std::vector<Point>& points);

/// For any path. Leaves out points while a straight line from the last kept point passes each of them within
/// `tolerance` pixels. Keeps a reversal on the same line. Takes one pass. Source: Zhao and Saalfeld, sleeve fitting,
/// 1997.
std::vector<Point> decimate_path(const std::vector<Point>& points, double tolerance);

}  // namespace lockstep::drawing
