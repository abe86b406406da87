// The path of a program as points for a drawing. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::web {

struct PathPoint {
    float x = 0;  // machine coordinates, mm; 0 where the machine has no such axis
    float y = 0;
    float z = 0;
    std::uint32_t line = 0;  // of the move that leads there
    bool is_rapid = false;
    bool operator==(const PathPoint&) const = default;
};

/// Returns the start, with line 0, and the points of each move that goes elsewhere.
std::vector<PathPoint> path_points(const Program& program);

struct ReducedPath {
    std::vector<PathPoint> points;
    double tolerance_mm = 0;  // the greatest distance of a left-out point from the line between the kept ones
};

/// Leaves out points until at most `most` remain, at least 2. Keeps the first and the last.
ReducedPath reduced_path(std::vector<PathPoint> points, std::size_t most);

/// Encodes each point in 16 bytes, little-endian: x, y, z, then the line with bit 31 for a rapid move.
std::string path_bytes(const std::vector<PathPoint>& points);

}  // namespace lockstep::web
