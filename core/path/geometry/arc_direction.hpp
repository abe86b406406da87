// Directions in the plane of an arc, by sums, products, quotients and roots only: the same on every machine.
#pragma once

#include <cmath>

namespace lockstep {

/// A unit vector. Clockwise arcs are mirrored, so that all arcs turn the same way.
struct ArcDirection {
    double x = 0;
    double y = 0;

    static ArcDirection of(double x, double y) {
        const double length = std::sqrt(x * x + y * y);
        return {x / length, y / length};
    }
    ArcDirection quarter_on() const { return {-y, x}; }
    ArcDirection turned(int quarters) const {
        ArcDirection direction = *this;
        for (int k = 0; k < quarters % 4; ++k) { direction = direction.quarter_on(); }
        return direction;
    }
    double dot(ArcDirection o) const { return x * o.x + y * o.y; }
    double cross(ArcDirection o) const { return x * o.y - y * o.x; }
};

/// The middle of two directions that are less than half a turn apart.
inline ArcDirection between(ArcDirection a, ArcDirection b) { return ArcDirection::of(a.x + b.x, a.y + b.y); }

}  // namespace lockstep
