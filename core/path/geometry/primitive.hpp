// The input of the path planner: lines, arcs and rests, in machine coordinates, with everything modal resolved.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/program.hpp"

namespace lockstep {

/// The settings of one move.
struct MoveSettings {
    std::optional<double> feed_mm_per_tick;  // along the path; nullopt: as fast as the axes allow
    PathMode mode = PathMode::Blend;
    double tolerance_mm = 0;     // Blend: the greatest deviation of an axis, steps included; at least one step
    bool is_feed_fixed = false;  // the feed override has no effect
    double most_mm_per_tick = std::numeric_limits<double>::infinity();  // for other reasons than the feed
    bool operator==(const MoveSettings&) const = default;
};

/// A straight move to a place, in mm, for each axis of the machine.
struct PathLine {
    std::vector<double> to_mm;
};

/// An arc to a place, in mm, for each axis of the machine.
struct PathArc {
    ArcShape shape;
    std::vector<double> to_mm;
};

}  // namespace lockstep
