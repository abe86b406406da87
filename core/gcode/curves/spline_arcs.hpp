// Converts splines to arcs that meet with the same direction. So motion along them does not stop between them, and the
// planner has to know only one kind of curve.
//
// Each part of a curve becomes two arcs that meet it at both ends in place and direction (K. Bolton, "Biarc curves",
// Computer-Aided Design 7, 1975). A part is halved until its arcs follow it. The error decreases with the cube of a
// part's length.
#pragma once

#include <algorithm>
#include <functional>

#include "core/gcode/motion.hpp"

namespace lockstep::gcode {

/// The greatest deviation of arcs from their spline, if chords of curves may deviate by `chord_tolerance_mm`, half a
/// step. It is a tenth of a step, as much as the planner's pieces of an arc deviate from it, but at most 1.25 um: the
/// fit is checked at seven places of a part, and a looser one deviates more between them.
constexpr double spline_tolerance_mm(double chord_tolerance_mm) { return std::min(chord_tolerance_mm / 5, 0.00125); }

/// Emits arcs, and straight moves where the curve is straight, in order. The last ends at the spline's own target. They
/// deviate from the curve by at most `tolerance_mm`.
void cut_into_arcs(const Spline& spline, const Point& from, double tolerance_mm,
                   const std::function<void(const Action&)>& take);

}  // namespace lockstep::gcode
