// Cutter compensation, G41 and G42: the path of the tool's centre, a radius beside the path in the program.
#pragma once

#include "core/gcode/run/arc_geometry.hpp"
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {

struct ArcMove {
    Point target{};  // in the program's coordinates
    Flat centre;
    int turns = 1;  // positive: counterclockwise
};

/// Along the arc, without compensation.
void move_arc(Context& context, const ArcMove& move);

Result compensated_straight(Context& context, const Point& target, bool rapid);
Result compensated_arc(Context& context, const ArcMove& move);

}  // namespace lockstep::gcode
