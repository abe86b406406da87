// Single moves keep the limits of every axis, and are as fast as these allow, on random moves and machines.
#include "core/motion/moves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/property/motion/random_move.hpp"

namespace lockstep {
namespace {

constexpr int kMoves = 20'000;

/// Of the four limits along the path, each is reached by one axis and exceeded by none.
TEST(MakeMove, GoesAsFastAsTheAxisThatAllowsTheLeast) {
    Random random(21);
    for (int run = 0; run < kMoves; ++run) {
        const Machine m = random_machine(random, 1 + random() % 5);
        const PathMove move = random_move(random, m);
        PathLimits nearest;  // the greatest part of its limit that an axis uses
        for (std::size_t i = 0; i < m.limits.size(); ++i) {
            const double share = std::abs(move.share(i));
            const AxisLimits& axis = m.limits[i];
            const auto use = [&](double& part, double along, double limit) {
                part = std::max(part, share * along / limit);
            };
            use(nearest.start_velocity, move.own.start_velocity, axis.start_velocity);
            use(nearest.max_velocity, move.own.max_velocity, axis.max_velocity);
            use(nearest.max_acceleration, move.own.max_acceleration, axis.max_acceleration);
            use(nearest.max_deceleration, move.own.max_deceleration, axis.max_deceleration);
        }
        for (const double part :
             {nearest.start_velocity, nearest.max_velocity, nearest.max_acceleration, nearest.max_deceleration}) {
            ASSERT_NEAR(part, 1, 1e-12) << "run " << run;
        }
    }
}

TEST(PlanAlone, IsTheFastestProfileWithinTheFeedAndTheLeastTime) {
    Random random(22);
    for (int run = 0; run < kMoves; ++run) {
        const Machine m = random_machine(random, 1 + random() % 4);
        const PathMove move = random_move(random, m);
        const Ticks least{static_cast<std::int64_t>(log_uniform(random, 1, 1e6))};
        const PathMove planned = plan_alone(move, {}, least);
        PathLimits limits = move.own;
        if (move.feed_mm_per_tick) {
            limits.max_velocity = std::min(limits.max_velocity, *move.feed_mm_per_tick / move.mm_per_lead());
        }
        limits.max_velocity =
            std::min(limits.max_velocity, static_cast<double>(move.lead) / static_cast<double>(least.value));
        limits.start_velocity = std::min(limits.start_velocity, limits.max_velocity);
        const Profile fastest =
            plan_fastest({{}, Displacement::steps(move.lead), limits.start_velocity, limits.start_velocity, limits});
        const std::int64_t off = planned.profile.duration().value - fastest.duration().value;
        ASSERT_LE(std::abs(off), kSubticksPerTick) << "run " << run;
        ASSERT_NEAR(planned.profile.peak_velocity(), fastest.peak_velocity(), 1e-9 * fastest.peak_velocity())
            << "run " << run;
        ASSERT_GE(planned.profile.duration(), subticks(least)) << "run " << run;
        ASSERT_EQ(planned.profile.phases.back().to, Displacement::steps(move.lead)) << "run " << run;
    }
}

/// Between any two speeds of which each is reachable from the other, in whole quanta: the phases join, the speed does
/// not jump within, and neither a limit nor the continuous optimum is exceeded.
TEST(PlanFastest, JoinsItsPhasesBetweenAnyTwoReachableSpeeds) {
    Random random(23);
    int with_three = 0;
    for (int run = 0; run < 4 * kMoves; ++run) {
        const PathLimits l = random_limits(random);
        const double n = static_cast<double>(static_cast<std::int64_t>(log_uniform(random, 1, 1e6)));
        const double entry = l.max_velocity * log_uniform(random, 1e-4, 1);
        const double most = std::min(l.max_velocity, std::sqrt(entry * entry + 2 * l.max_acceleration * n));
        const double least = std::sqrt(std::max(0.0, entry * entry - 2 * l.max_deceleration * n));
        const std::uint64_t which = random() % 4;  // also exactly the speeds that can just be reached
        const double exit = which == 0   ? most
                            : which == 1 ? least
                                         : least + (most - least) * log_uniform(random, 1e-3, 1);
        const std::int64_t quantum = random() % 2 == 0 ? kSubticksPerTick : 1;
        const Displacement to = Displacement::steps(static_cast<std::int64_t>(n));
        const Profile p = plan_fastest({{}, to, entry, exit, l, quantum});
        Displacement at;
        double speed = p.phases.front().velocity_at({});
        ASSERT_LE(speed, entry * (1 + 1e-9) + 1e-14) << "run " << run;
        for (const ProfilePhase& phase : p.phases) {
            ASSERT_EQ(phase.from, at) << "run " << run;
            ASSERT_GT(phase.duration.value, 0) << "run " << run;
            ASSERT_EQ(phase.duration.value % quantum, 0) << "run " << run;
            const double slack = 1e-6 * l.max_velocity + 2 / static_cast<double>(phase.duration.value);
            ASSERT_NEAR(phase.velocity_at({}), speed, slack) << "run " << run;
            speed = phase.velocity_at(phase.duration);
            at = phase.to;
        }
        ASSERT_EQ(at, to) << "run " << run;
        with_three += p.phases.size() == 3 ? 1 : 0;
    }
    EXPECT_GT(with_three, kMoves / 4);
}

}  // namespace
}  // namespace lockstep
