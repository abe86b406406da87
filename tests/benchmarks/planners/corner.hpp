// Corner speeds limited by a deviation, as Klipper and grbl limit them.
//
// An arc that touches both moves and leaves their corner by d has the radius d s / (1 - s), where s is the sine of half
// the angle between the moves. At the speed v^2 = a d s / (1 - s) the centripetal acceleration on it would be a. The
// machine does not follow this arc: at the corner its speed jumps.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/benchmarks/planners/straight_moves.hpp"

namespace lockstep::planners {

struct Corner {
    double sine = 0;  // of half the angle between the moves: 1 straight on, 0 back
    double cosine = 0;

    bool is_straight() const { return cosine == 0 || sine >= 1; }
    /// Ratio of the radius to the deviation. This and tangent() are undefined for a straight corner.
    double radius_ratio() const { return sine / (1 - sine); }
    double tangent() const { return sine / cosine; }
};

inline Corner corner_between(const Vector& before, const Vector& after) {
    double turn = 0;  // the cosine of the angle by which the direction changes
    for (std::size_t i = 0; i < kAxes; ++i) { turn += before[i] * after[i]; }
    return {.sine = std::sqrt(std::max(0.0, (1 + turn) / 2)), .cosine = std::sqrt(std::max(0.0, (1 - turn) / 2))};
}

}  // namespace lockstep::planners
