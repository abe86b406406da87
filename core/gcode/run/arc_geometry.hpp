// The geometry of an arc in its plane, in mm, in the program's coordinates.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/enumeration.hpp"
#include "core/gcode/motion.hpp"
#include "core/gcode/state.hpp"

namespace lockstep::gcode {

/// The axes of a plane: counterclockwise is from the first to the second, seen from the tip of the normal.
struct PlaneAxes {
    std::size_t first;
    std::size_t second;
    std::size_t normal;
};

constexpr PlaneAxes axes_of(Plane plane) {
    constexpr std::array kAll{PlaneAxes{0, 1, 2}, PlaneAxes{2, 0, 1}, PlaneAxes{1, 2, 0}};
    return pick_row(kAll, plane);
}

constexpr Flat in_plane(PlaneAxes axes, const Point& point) { return {point[axes.first], point[axes.second]}; }

/// The angle of an arc, above 0. With one turn it is at most a whole turn.
inline double sweep_of(Flat from, Flat centre, Flat to, bool counterclockwise, int turns) {
    constexpr double kWhole = 2 * std::numbers::pi;
    const Flat a = from - centre;
    const Flat b = to - centre;
    double angle = std::atan2(cross(a, b), dot(a, b));
    if (!counterclockwise) { angle = -angle; }
    constexpr double kNone = 1e-10;  // rad; with a smaller angle between its ends an arc is a whole turn
    if (angle <= kNone) { angle += kWhole; }
    return angle + kWhole * (turns - 1);
}

}  // namespace lockstep::gcode
