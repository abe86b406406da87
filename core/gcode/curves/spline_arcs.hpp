// Splines as arcs, which meet with the same direction: motion along them needs no stop between them, and the planner
// has one curve to know.
//
// Each part of a curve becomes two arcs that meet it at both ends in place and direction (K. Bolton, "Biarc curves",
// Computer-Aided Design 7, 1975). A part is halved until its arcs follow it. The error decreases with the cube of a
// part's length.
#pragma once

#include <functional>

#include "core/gcode/motion.hpp"

namespace lockstep::gcode {

/// Arcs and straight moves leave the curve by so little, in mm. No more than what counts as within the travel.
inline constexpr double kSplineArcs_mm = 1e-6;

/// The arcs, and straight moves where the curve is straight, in order; the last ends at the spline's own target.
void cut_into_arcs(const Spline& spline, const Point& from, const std::function<void(const Action&)>& take);

}  // namespace lockstep::gcode
