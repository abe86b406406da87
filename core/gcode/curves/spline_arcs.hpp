// Converts splines to arcs that meet with the same direction. So motion along them does not stop between them, and the
// planner has to know only one kind of curve.
//
// Each part of a curve becomes two arcs that meet it at both ends in place and direction (K. Bolton, "Biarc curves",
// Computer-Aided Design 7, 1975). A part is halved until its arcs follow it. The error decreases with the cube of a
// part's length.
#pragma once

#include <functional>

#include "core/gcode/motion.hpp"

namespace lockstep::gcode {

/// The greatest deviation of arcs and straight moves from the curve, in mm. At most kTravelTolerance_mm (gcode.hpp).
inline constexpr double kSplineArcs_mm = 1e-6;

/// Emits arcs, and straight moves where the curve is straight, in order. The last ends at the spline's own target.
void cut_into_arcs(const Spline& spline, const Point& from, const std::function<void(const Action&)>& take);

}  // namespace lockstep::gcode
