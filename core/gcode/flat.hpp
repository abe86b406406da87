// A place or a vector in a plane, in mm.
#pragma once

#include <cmath>

namespace lockstep::gcode {

struct Flat {
    double x = 0;  // along the plane's first axis
    double y = 0;
    bool operator==(const Flat&) const = default;
};

constexpr Flat operator+(Flat a, Flat b) { return {a.x + b.x, a.y + b.y}; }
constexpr Flat operator-(Flat a, Flat b) { return {a.x - b.x, a.y - b.y}; }
constexpr Flat operator*(Flat a, double factor) { return {a.x * factor, a.y * factor}; }
constexpr double dot(Flat a, Flat b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Flat a, Flat b) { return a.x * b.y - a.y * b.x; }
constexpr Flat left_of(Flat a) { return {-a.y, a.x}; }
inline double length_of(Flat a) { return std::sqrt(dot(a, a)); }

}  // namespace lockstep::gcode
