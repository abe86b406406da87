// What every plan promises, on random moves and machines with fixed seeds.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/motion/interpolate.hpp"
#include "core/motion/lookahead.hpp"
#include "core/motion/strain.hpp"

namespace lockstep {
namespace {

using Random = std::mt19937_64;

double log_uniform(Random& random, double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>(0, 1)(random));
}

PathLimits random_limits(Random& random) {
    PathLimits l;
    l.max_velocity = log_uniform(random, 1e-4, 0.49);
    l.start_velocity = l.max_velocity * log_uniform(random, 1e-3, 1);
    l.max_acceleration = log_uniform(random, 1e-10, 1e-6);
    l.max_deceleration = l.max_acceleration * log_uniform(random, 0.2, 5);
    return l;
}

/// The duration of the continuous-time optimum in ticks, by textbook formulas.
double optimum_ticks(double n, const PathLimits& l) {
    const double v0 = l.start_velocity, a = l.max_acceleration, d = l.max_deceleration;
    const double top = std::min(l.max_velocity, std::sqrt(v0 * v0 + 2 * n * a * d / (a + d)));
    const double ramps = (top * top - v0 * v0) / 2 * (1 / a + 1 / d);
    return (top - v0) / a + (top - v0) / d + std::max(0.0, n - ramps) / top;
}

TEST(Planner, IsNeverFasterThanTheContinuousOptimumNorSlowerByMoreThanThreeTicks) {
    Random random(1);
    for (int run = 0; run < 50'000; ++run) {
        const PathLimits l = random_limits(random);
        const auto n = static_cast<std::int64_t>(log_uniform(random, 1, 1e9));
        const Profile p = plan_fastest({{}, Displacement::steps(n), l.start_velocity, l.start_velocity, l});
        const double ticks = static_cast<double>(p.duration().value) / kSubticksPerTick;
        const double best = optimum_ticks(static_cast<double>(n), l);
        ASSERT_GE(ticks, best * (1 - 1e-9)) << "run " << run;
        ASSERT_LE(ticks, best * (1 + 1e-9) + 3.001) << "run " << run;
    }
}

TEST(Planner, KeepsSpeedAndAccelerationLimitsInEveryPhase) {
    Random random(2);
    for (int run = 0; run < 50'000; ++run) {
        const PathLimits l = random_limits(random);
        const auto n = static_cast<std::int64_t>(log_uniform(random, 1, 1e9));
        const Profile p = plan_fastest({{}, Displacement::steps(n), l.start_velocity, l.start_velocity, l});
        ASSERT_LE(p.peak_velocity(), l.max_velocity * (1 + 1e-9) + 1e-14) << "run " << run;
        ASSERT_LE(p.velocity_at({0}), l.start_velocity * (1 + 1e-9) + 1e-14) << "run " << run;
        ASSERT_LE(p.velocity_at(p.duration()), l.start_velocity * (1 + 1e-6) + 1e-12) << "run " << run;
        for (const Phase& phase : p.phases) {
            ASSERT_LE(phase.acceleration(), l.max_acceleration * (1 + 1e-6) + 1e-15) << "run " << run;
            ASSERT_GE(phase.acceleration(), -l.max_deceleration * (1 + 1e-6) - 1e-15) << "run " << run;
        }
    }
}

TEST(PlanInTime, AMoveIsFeasibleIfAndOnlyIfTheGivenTimeIsNotBelowTheFastest) {
    Random random(3);
    for (int run = 0; run < 50'000; ++run) {
        PathLimits l = random_limits(random);
        l.max_deceleration = l.max_acceleration;
        const auto n = static_cast<std::int64_t>(log_uniform(random, 1, 1e6));
        const double best = optimum_ticks(static_cast<double>(n), l);
        const Ticks asked{static_cast<std::int64_t>(best * log_uniform(random, 0.5, 2))};
        const auto p = plan_in_time(Displacement::steps(n), asked, l);
        const auto t = static_cast<double>(asked.value);
        if (t < best * (1 - 1e-6) - 1) { ASSERT_FALSE(p.has_value()) << "run " << run; }
        if (t > best * (1 + 1e-6) + 4) {
            ASSERT_TRUE(p.has_value()) << "run " << run;
            ASSERT_EQ(p->duration(), subticks(asked));
            ASSERT_LE(p->peak_velocity(), l.max_velocity * (1 + 1e-7));
        }
        if (!p) { ASSERT_NEAR(static_cast<double>(p.error().least_ticks.value), best, best * 1e-6 + 4); }
    }
}

struct Machine {
    std::vector<AxisLimits> limits;
    std::vector<double> steps_per_mm;
};

Machine random_machine(Random& random, std::size_t axes) {
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

std::vector<PathMove> random_moves(Random& random, const Machine& m, std::size_t count) {
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

constexpr PathBounds kBounds{Ticks{400}, 24};

/// Follows the pieces of all axes tick by tick and checks every limit and the distance from the path's own place.
void expect_within_limits(const Path& path, const Machine& m, std::vector<Position> at, bool ends_on_path) {
    std::vector<double> last(m.limits.size(), 0);
    std::vector<Strain> strain(m.limits.size());
    std::vector<Piece> pieces(m.limits.size());
    std::vector<Position> cursor = at;
    PieceSource source(path, Ticks{0}, path.duration().ceil(), cursor);
    Ticks clock;
    while (source.next(pieces)) {
        clock += pieces[0].ticks;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const AxisLimits& l = m.limits[i];
            const double a = pieces[i].acceleration.steps_per_tick2();
            const double n = static_cast<double>(pieces[i].ticks.value);
            const double v0 = pieces[i].velocity.steps_per_tick() + a / 2;
            const double v1 = v0 + a * n;
            const double one_tick = 2 * std::max(l.max_acceleration, l.max_deceleration);
            strain[i].add(v0 - last[i], 0, 0);
            ASSERT_LE(strain[i].most(), l.start_velocity * (1 + 1e-6) + one_tick) << "tick " << clock.value;
            strain[i].add(v1 - v0, n, std::max(l.max_acceleration, l.max_deceleration) * (1 + 1e-6));
            ASSERT_LE(std::max(std::abs(v0), std::abs(v1)), l.max_velocity * (1 + 1e-6) + one_tick);
            const bool speeding = std::abs(v1) > std::abs(v0);
            ASSERT_LE(std::abs(a), (speeding ? l.max_acceleration : l.max_deceleration) * (1 + 1e-6))
                << "tick " << clock.value << " of " << path.duration().ceil().value << " n " << n << " v0 " << v0
                << " v1 " << v1;
            last[i] = v1;
            at[i] = at[i] + pieces[i].covered();
        }
    }
    for (std::size_t i = 0; i < last.size(); ++i) {
        strain[i].add(-last[i], 0, 0);
        ASSERT_LE(strain[i].most(), m.limits[i].start_velocity * (1 + 1e-6) + 2 * m.limits[i].max_deceleration);
        if (ends_on_path) { ASSERT_EQ(at[i].count(), path.moves.back().to[i]); }
    }
}

TEST(JoinedMoves, KeepEveryAxisWithinItsLimitsThroughEveryCorner) {
    Random random(4);
    for (int run = 0; run < 300; ++run) {
        const Machine m = random_machine(random, 1 + random() % 5);
        const Path path = plan_path(random_moves(random, m, 1 + random() % 40), {}, m.limits, kBounds);
        std::vector<Position> at;
        for (std::size_t i = 0; i < m.limits.size(); ++i) { at.push_back(start_of(path, i, 0)); }
        SCOPED_TRACE(run);
        expect_within_limits(path, m, at, true);
        if (HasFatalFailure()) { return; }
    }
}

TEST(JoinedMoves, EveryStopOnThePathKeepsTheLimitsAndFitsATail) {
    Random random(5);
    for (int run = 0; run < 200; ++run) {
        const Machine m = random_machine(random, 1 + random() % 4);
        const Path path = plan_path(random_moves(random, m, 1 + random() % 60), {}, m.limits, kBounds);
        for (int stop = 0; stop < 10; ++stop) {
            const auto whole = path.duration().floor().value;
            const Ticks when{static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(whole))};
            const Path tail = brake_from(path, subticks(when), m.limits);
            ASSERT_LE(tail.moves.size(), kBounds.stop_moves) << "run " << run;
            if (tail.empty()) { continue; }
            std::vector<Position> at;
            for (std::size_t i = 0; i < m.limits.size(); ++i) {
                const PathMove& move = path.moves[path.move_at(subticks(when))];
                at.push_back(move.axis_at(i, move.profile.at(subticks(when) - move.start)));
            }
            std::vector<Piece> pieces(m.limits.size());
            PieceSource source(tail, Ticks{0}, tail.duration().ceil(), at);
            std::vector<double> speed(m.limits.size());
            while (source.next(pieces)) {
                for (std::size_t i = 0; i < pieces.size(); ++i) {
                    const double a = pieces[i].acceleration.steps_per_tick2();
                    const double v0 = pieces[i].velocity.steps_per_tick() + a / 2;
                    const double v1 = v0 + a * static_cast<double>(pieces[i].ticks.value);
                    const bool speeding = std::abs(v1) > std::abs(v0);
                    ASSERT_LE(std::abs(a),
                              (speeding ? m.limits[i].max_acceleration : m.limits[i].max_deceleration) * (1 + 1e-6));
                    speed[i] = v1;
                }
            }
            for (std::size_t i = 0; i < speed.size(); ++i) {
                ASSERT_LE(std::abs(speed[i]),
                          m.limits[i].start_velocity * (1 + 1e-6) + 2 * m.limits[i].max_deceleration)
                    << "run " << run;
            }
        }
    }
}

TEST(Interpolation, EveryAxisIsWithinOneStepOfTheLineAtEveryTick) {
    Random random(6);
    for (int run = 0; run < 40; ++run) {
        const Machine m = random_machine(random, 3);
        const auto moves = random_moves(random, m, 1);
        const Path path = plan_path(moves, {}, m.limits, kBounds);
        const PathMove& move = path.moves[0];
        std::vector<Position> at;
        for (std::size_t i = 0; i < 3; ++i) { at.push_back(start_of(path, i, 0)); }
        std::vector<Position> cursor = at;
        std::vector<Piece> pieces(3);
        PieceSource source(path, Ticks{0}, path.duration().ceil(), cursor);
        while (source.next(pieces)) {
            for (Ticks n{1}; n <= pieces[0].ticks; n += Ticks{97}) {
                std::array<double, 3> count{};
                for (std::size_t i = 0; i < 3; ++i) {
                    count[i] = static_cast<double>((at[i] + pieces[i].covered(n)).count());
                }
                double along = 0, square = 0;  // nearest place on the line
                for (std::size_t i = 0; i < 3; ++i) {
                    along += count[i] * static_cast<double>(move.to[i]);
                    square += std::pow(static_cast<double>(move.to[i]), 2);
                }
                for (std::size_t i = 0; i < 3; ++i) {
                    ASSERT_LE(std::abs(count[i] - along / square * static_cast<double>(move.to[i])), 1.0);
                }
            }
            for (std::size_t i = 0; i < 3; ++i) { at[i] = at[i] + pieces[i].covered(); }
        }
    }
}

}  // namespace
}  // namespace lockstep
