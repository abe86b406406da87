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

/// The start, with line 0, and the end of each move that goes elsewhere.
std::vector<PathPoint> path_points(const Program& program);

struct ReducedPath {
    std::vector<PathPoint> points;
    double tolerance_mm = 0;  // a point that was left out is at most so far from the line between those kept
};

/// At most `most` points, at least 2; the first and the last stay.
ReducedPath reduced_path(std::vector<PathPoint> points, std::size_t most);

/// 16 bytes for each, little-endian: x, y, z, then the line with bit 31 for a rapid move.
std::string path_bytes(const std::vector<PathPoint>& points);

}  // namespace lockstep::web
