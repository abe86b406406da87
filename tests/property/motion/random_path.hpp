// Random machines and moves for the promises of every plan, and a check of the requirements of its pieces on the axes.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "core/motion/interpolate.hpp"
#include "core/motion/lookahead.hpp"
#include "core/motion/strain.hpp"

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

inline std::vector<PathMove> random_moves(Random& random, const Machine& m, std::size_t count) {
    std::uniform_real_distribution<> unit(-1, 1);
    std::vector<PathMove> moves;
    AxisCounts at;
    for (std::size_t i = 0; i < m.limits.size(); ++i) { (void)at.push_back(0); }
    while (moves.size() < count) {
        const double size_mm = log_uniform(random, 0.05, 20);
        AxisCounts to = at;
        for (std::size_t i = 0; i < m.limits.size(); ++i) {
            if (random() % 4 != 0) { to[i] += std::llround(unit(random) * size_mm * m.steps_per_mm[i]); }
        }
        const PathMove move =
            make_move(at, to, m.limits, m.steps_per_mm, random() % 3 == 0 ? 0 : log_uniform(random, 1e-5, 2e-4));
        if (move.lead == 0) { continue; }
        moves.push_back(move);
        at = to;
    }
    return moves;
}

inline constexpr PathBounds kBounds{Ticks{400}, 24};

/// The positions and speeds of the axes: checks every limit of each axis as it follows its pieces.
class PathLimitWatch {
public:
    PathLimitWatch(const Machine& machine, const Path& path) : limits_(machine.limits), axes_(machine.limits.size()) {
        for (std::size_t i = 0; i < axes_.size(); ++i) { axes_[i].at = start_of(path, i, 0); }
    }

    std::vector<Position> at() const {
        std::vector<Position> places;
        for (const Axis& axis : axes_) { places.push_back(axis.at); }
        return places;
    }

    /// Follows the ticks [begin, end) of a path.
    void follow(const Path& path, Ticks begin, Ticks end) {
        std::vector<Piece> pieces(axes_.size());
        std::vector<Position> cursor = at();
        PieceSource source(path, begin, end, cursor);
        while (source.next(pieces)) {
            for (std::size_t i = 0; i < pieces.size(); ++i) { ASSERT_NO_FATAL_FAILURE(take(i, pieces[i])) << clock_; }
            clock_ += pieces[0].ticks.value;
        }
    }

    void expect_rest() {
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            axes_[i].strain.add(-axes_[i].speed, 0, 0);
            axes_[i].speed = 0;
            ASSERT_LE(axes_[i].strain.most(), limits_[i].start_velocity * (1 + 1e-6) + one_tick(limits_[i]));
        }
    }

    double speed(std::size_t axis) const { return axes_[axis].speed; }

private:
    struct Axis {
        Position at;
        double speed = 0;
        Strain strain;
    };

    static double one_tick(const AxisLimits& l) { return 2 * std::max(l.max_acceleration, l.max_deceleration); }

    void take(std::size_t i, const Piece& piece) {
        const AxisLimits& l = limits_[i];
        Axis& axis = axes_[i];
        const double a = piece.acceleration.steps_per_tick2();
        const double n = static_cast<double>(piece.ticks.value);
        const double v0 = piece.velocity.steps_per_tick() + a / 2;
        const double v1 = v0 + a * n;
        axis.strain.add(v0 - axis.speed, 0, 0);
        ASSERT_LE(axis.strain.most(), l.start_velocity * (1 + 1e-6) + one_tick(l)) << "axis " << i;
        axis.strain.add(v1 - v0, n, std::max(l.max_acceleration, l.max_deceleration) * (1 + 1e-6));
        ASSERT_LE(std::max(std::abs(v0), std::abs(v1)), l.max_velocity * (1 + 1e-6) + one_tick(l)) << "axis " << i;
        const bool speeding = std::abs(v1) > std::abs(v0);
        ASSERT_LE(std::abs(a), (speeding ? l.max_acceleration : l.max_deceleration) * (1 + 1e-6))
            << "axis " << i << ", from " << v0 << " to " << v1 << " in " << n << " ticks";
        axis.speed = v1;
        axis.at = axis.at + piece.covered();
    }

    std::vector<AxisLimits> limits_;
    std::vector<Axis> axes_;
    std::int64_t clock_ = 0;
};

}  // namespace lockstep
