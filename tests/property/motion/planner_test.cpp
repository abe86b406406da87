// The promises of every plan, on random moves and machines with fixed seeds.
#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/interpolate.hpp"
#include "tests/property/motion/random_move.hpp"

namespace lockstep {
namespace {

/// The duration of the continuous-time optimum in ticks, by textbook formulas.
double optimum_ticks(double n, const PathLimits& l) {
    const double v0 = l.start_velocity, a = l.max_acceleration, d = l.max_deceleration;
    const double top = std::min(l.max_velocity, std::sqrt(v0 * v0 + 2 * n * a * d / (a + d)));
    const double ramps = (top * top - v0 * v0) / 2 * (1 / a + 1 / d);
    return (top - v0) / a + (top - v0) / d + std::max(0.0, n - ramps) / top;
}

TEST(Planner, IsNeverFasterThanTheContinuousOptimumNorSlowerByMoreThanTwoTicks) {
    constexpr int kRuns = 50'000;
    Random random(1);
    int within_one = 0;
    for (int run = 0; run < kRuns; ++run) {
        const PathLimits l = random_limits(random);
        const auto n = static_cast<std::int64_t>(log_uniform(random, 1, 1e9));
        const Profile p = plan_fastest({{}, Displacement::steps(n), l.start_velocity, l.start_velocity, l});
        const double ticks = static_cast<double>(p.duration().value) / kSubticksPerTick;
        const double best = optimum_ticks(static_cast<double>(n), l);
        ASSERT_GE(ticks, best * (1 - 1e-9)) << "run " << run;
        ASSERT_LE(ticks, best * (1 + 1e-9) + 2.001) << "run " << run;
        within_one += ticks <= best * (1 + 1e-9) + 1.001 ? 1 : 0;
    }
    EXPECT_GT(within_one, kRuns / 2);
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
        for (const ProfilePhase& phase : p.phases) {
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

TEST(Interpolation, EveryAxisIsWithinOneStepOfTheLineAtEveryTick) {
    Random random(6);
    for (int run = 0; run < 40; ++run) {
        const Machine m = random_machine(random, 3);
        const Path path{{plan_alone(random_move(random, m), {}, Ticks{400})}};
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
