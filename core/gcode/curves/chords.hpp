// Arcs and splines as chords: straight moves that leave the curve by a tolerance at most.
#pragma once

#include <functional>

#include "core/gcode/motion.hpp"

namespace lockstep::gcode {

/// The end of each chord, in order; the last is the curve's own target.
using TakeChord = std::function<void(const Point& target)>;

/// `tolerance` is in mm, above 0: how far a chord's middle may be from the curve.
void cut(const Arc& arc, const Point& from, double tolerance, const TakeChord& take);
void cut(const Spline& spline, const Point& from, double tolerance, const TakeChord& take);

}  // namespace lockstep::gcode
