// A vertex of a programmed polyline.
#pragma once

#include <cstdint>

#include "core/path/axis_vector.hpp"
#include "core/path/primitive.hpp"

namespace lockstep {

struct PathPoint {
    AxisVector at;            // steps
    double along = 0;         // mm from the polyline's start
    MoveSettings settings;    // of the chord that ends here
    std::uint32_t block = 0;  // of the program, of the chord that ends here
    double turn = 0;          // 1 - cosine of the angle between the directions on either side
    bool is_corner = false;
    bool is_end = false;  // a piece ends here
};

}  // namespace lockstep
