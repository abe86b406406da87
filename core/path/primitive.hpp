// What a program asks of the path: lines, arcs and rests, in machine coordinates, with everything modal resolved.
#pragma once

#include <cstdint>
#include <vector>

#include "core/units.hpp"

namespace lockstep {

/// How the path follows the program.
enum class PathMode : std::uint8_t {
    Blend,      // moves are joined where the deviation stays within the tolerance (G64)
    ExactPath,  // every corner is reached exactly, at the speed that the start velocity allows there (G61)
    ExactStop,  // the machine rests at the end of every move (G61.1)
};

/// What holds for one move.
struct MoveSettings {
    double feed_mm_per_tick = 0;  // along the path; 0: as fast as the axes allow
    PathMode mode = PathMode::Blend;
    double tolerance_mm = 0;  // Blend: the greatest deviation of an axis, steps included; never less than one step
    bool operator==(const MoveSettings&) const = default;
};

/// A straight move to a place, in mm, for each axis of the machine.
struct PathLine {
    std::vector<double> to_mm;
};

/// An arc in the plane of two axes. All other axes move in proportion to its angle (a helix). Where the distances of
/// its ends from the centre differ, the radius changes in proportion to the angle (a spiral).
struct PathArc {
    std::size_t first = 0;  // axes of the plane: counter-clockwise is from the first to the second
    std::size_t second = 1;
    double centre_first_mm = 0;
    double centre_second_mm = 0;
    bool is_clockwise = false;
    int turns = 1;  // from 1: the arc ends when it reaches its end for this number of times
    std::vector<double> to_mm;
};

}  // namespace lockstep
