// The speeds that a planner gives to a straight move: it accelerates, keeps a speed, and decelerates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/benchmarks/planners/straight_moves.hpp"

namespace lockstep::planners {

/// Squares of speeds along the path, in mm^2/s^2. With a constant acceleration a square is linear in the distance.
struct Trapezoid {
    double begin2 = 0;
    double cruise2 = 0;  // at least the speeds at the ends
    double end2 = 0;
    double acceleration = 0;  // mm/s^2, both ways
};

/// One per move.
using Speeds = std::vector<Trapezoid>;

/// A part of a move with a constant acceleration.
struct Phase {
    double seconds = 0;
    double velocity = 0;  // at its begin, mm/s
    double acceleration = 0;
};

inline std::array<Phase, 3> phases_of(const Trapezoid& speeds, double length_mm) {
    const double a = speeds.acceleration;
    const double begin = std::sqrt(speeds.begin2);
    const double cruise = std::sqrt(speeds.cruise2);
    const double changing = (2 * speeds.cruise2 - speeds.begin2 - speeds.end2) / (2 * a);
    const double kept = std::max(0.0, length_mm - changing);
    return {Phase{(cruise - begin) / a, begin, a}, Phase{kept / cruise, cruise, 0},
            Phase{(cruise - std::sqrt(speeds.end2)) / a, cruise, -a}};
}

inline double seconds_of(const std::vector<StraightMove>& moves, const Speeds& speeds) {
    double seconds = 0;
    for (std::size_t k = 0; k < moves.size(); ++k) {
        for (const Phase& phase : phases_of(speeds[k], moves[k].length_mm)) { seconds += phase.seconds; }
    }
    return seconds;
}

}  // namespace lockstep::planners
