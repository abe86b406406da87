// Keeps a path within the travel. A place beyond the last step belongs to this step if it rounds to it.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/path/geometry/quadratic.hpp"
#include "core/path/path_setup.hpp"

namespace lockstep {

/// Steps that a path may lead beyond the last step of the travel.
inline constexpr double kMostBeyond_steps = 1 - kPulseShare - kFitShare - kRoundingShare;

struct TravelEnds {
    double least;
    double greatest;
};
inline TravelEnds travel_ends_of(const AxisLimits& axis) {
    return {static_cast<double>(axis.min_steps) - kMostBeyond_steps,
            static_cast<double>(axis.max_steps) + kMostBeyond_steps};
}

/// Reduces the bend of a piece that leads beyond the travel; its ends must be within. A parabola through (0, x0) and
/// (L, x1) touches a line that is p and q away from them if its bend is 2 (sqrt p + sqrt q)^2 / L^2, which is more than
/// 2 (p + q) / L^2.
inline void keep_within_travel(const PathSetup& setup, Quadratic& piece) {
    const auto most = [&piece](double p, double q) {
        const double root = (std::sqrt(std::max(p, 0.0)) + std::sqrt(std::max(q, 0.0))) / piece.length;
        return 2 * root * root;
    };
    constexpr double kCertain = 2 - 1e-9;  // 2, with room for rounding
    for (const AxisIndex i : axis_indices(setup.axes())) {
        double& bend = piece.bend.begin()[i];
        if (bend == 0) { continue; }
        const TravelEnds travel = travel_ends_of(setup.limits_of_axis(i));
        const double begin = piece.from.begin()[i];
        const double end = piece.place(i, piece.length);
        const double up = travel.greatest - begin + travel.greatest - end;
        const double down = begin - travel.least + end - travel.least;
        if (std::abs(bend) * piece.length * piece.length < kCertain * std::min(up, down)) { continue; }
        bend = std::clamp(bend, -most(travel.greatest - begin, travel.greatest - end),
                          most(begin - travel.least, end - travel.least));
    }
}

}  // namespace lockstep
