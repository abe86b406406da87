// A corner of a path, and where the paths of the tool's centre before and after it meet. In a plane, in mm.
#pragma once

#include <cstdint>
#include <optional>

#include "core/gcode/run/arc_geometry.hpp"

namespace lockstep::gcode {

/// The path of the tool's centre at a corner: a line, or a circle about `centre`.
struct Track {
    Flat at;         // beside the corner
    Flat direction;  // there; length 1
    std::optional<Flat> centre;
    double radius = 0;  // of the circle
};

enum class CornerKind : std::uint8_t { Straight, Outside, Inside };

/// Two directions that differ by less, in radians, make no corner (LinuxCNC's tolerance).
inline constexpr double kLeastCorner = 0.05;

/// `radius`: of the tool; above 0 if its centre is on the left. A path that turns back is an outside corner, unless the
/// two curves bend toward each other on the tool's side.
CornerKind corner_between(const Track& before, const Track& after, Flat corner, double radius);

/// The place on both tracks that is nearest to the corner, if possible not beyond the end of the first. Returns nullopt
/// if they do not meet.
std::optional<Flat> meeting(const Track& before, const Track& after, Flat corner);

}  // namespace lockstep::gcode
