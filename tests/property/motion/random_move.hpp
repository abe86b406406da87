// Random machines, moves and limits along a path.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "core/motion/moves.hpp"

namespace lockstep {

using Random = std::mt19937_64;

inline double log_uniform(Random& random, double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>(0, 1)(random));
}

struct Machine {
    std::vector<AxisLimits> limits;
    std::vector<double> steps_per_mm;
};

inline Machine random_machine(Random& random, std::size_t axes) {
    Machine m;
    for (std::size_t i = 0; i < axes; ++i) {
        const double scale = log_uniform(random, 20, 800);
        const double top = log_uniform(random, 20, 200) * scale * 1e-6;
        m.steps_per_mm.push_back(scale);
        m.limits.push_back({.start_velocity = log_uniform(random, 2, 15) * scale * 1e-6,
                            .max_velocity = std::min(top, 0.4),
                            .max_acceleration = log_uniform(random, 200, 5'000) * scale * 1e-12,
                            .max_deceleration = log_uniform(random, 200, 5'000) * scale * 1e-12});
    }
    return m;
}

inline PathMove random_move(Random& random, const Machine& m) {
    std::uniform_real_distribution<> unit(-1, 1);
    AxisCounts from;
    for (std::size_t i = 0; i < m.limits.size(); ++i) { from.append(0); }
    for (;;) {
        const double size_mm = log_uniform(random, 0.05, 20);
        AxisCounts to = from;
        for (std::size_t i = 0; i < m.limits.size(); ++i) {
            if (random() % 4 != 0) { to[i] += std::llround(unit(random) * size_mm * m.steps_per_mm[i]); }
        }
        std::optional<double> feed;
        if (random() % 3 != 0) { feed = log_uniform(random, 1e-5, 2e-4); }
        const PathMove move = make_move(from, to, m.limits, m.steps_per_mm, feed);
        if (move.lead != 0) { return move; }
    }
}

inline PathLimits random_limits(Random& random) {
    PathLimits l;
    l.max_velocity = log_uniform(random, 1e-4, 0.49);
    l.start_velocity = l.max_velocity * log_uniform(random, 1e-3, 1);
    l.max_acceleration = log_uniform(random, 1e-10, 1e-6);
    l.max_deceleration = l.max_acceleration * log_uniform(random, 0.2, 5);
    return l;
}

}  // namespace lockstep
