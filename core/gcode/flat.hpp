// A place or a vector in a plane, in mm.
#pragma once

namespace lockstep::gcode {

struct Flat {
    double x = 0;  // along the plane's first axis
    double y = 0;
    bool operator==(const Flat&) const = default;
};

}  // namespace lockstep::gcode
