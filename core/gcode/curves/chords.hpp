// Cuts arcs and splines into chords: straight moves that deviate from the curve by at most a tolerance.
#pragma once

#include <functional>

#include "core/gcode/motion.hpp"

namespace lockstep::gcode {

/// Receives the end of each chord, in order; the last is the curve's own target.
using TakeChord = std::function<void(const Point& target)>;

/// `tolerance` is in mm, above 0: the greatest distance of a chord's middle from the curve.
void cut(const Arc& arc, const Point& from, double tolerance, const TakeChord& take);
/// How many chords cut() makes of an arc.
double chords_in(const Arc& arc, const Point& from, double tolerance);
void cut(const Spline& spline, const Point& from, double tolerance, const TakeChord& take);

}  // namespace lockstep::gcode
