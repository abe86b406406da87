#include "core/motion/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/interpolate.hpp"

namespace lockstep {
namespace {

constexpr double kPerSecond = 1e-6;  // steps/s to steps per tick of 1 us
constexpr double kPerSecond2 = 1e-12;

PathLimits limits(double start, double top, double acceleration, double deceleration) {
    return {start * kPerSecond, top * kPerSecond, acceleration * kPerSecond2, deceleration * kPerSecond2};
}

Profile fastest(std::int64_t steps, const PathLimits& l) {
    return plan_fastest({{}, Displacement::steps(steps), l.start_velocity, l.start_velocity, l});
}

TEST(PlanFastest, ALongMoveIsATrapezoidInWholeTicks) {
    const Profile p = fastest(12'000, limits(500, 6'000, 4'200, 4'200));
    ASSERT_EQ(p.phases.size(), 3u);
    for (const ProfilePhase& phase : p.phases) { EXPECT_EQ(phase.duration.value % kSubticksPerTick, 0); }
    EXPECT_LE(p.peak_velocity(), 6'000 * kPerSecond * (1 + 1e-9));
    EXPECT_GT(p.peak_velocity(), 5'999.9 * kPerSecond);
}

TEST(PlanFastest, AShortMoveIsATriangle) {
    const Profile p = fastest(200, limits(500, 6'000, 4'200, 8'400));
    ASSERT_EQ(p.phases.size(), 2u);
    EXPECT_NEAR(p.phases[0].acceleration() / kPerSecond2, 4'200, 1);
    EXPECT_NEAR(p.phases[1].acceleration() / kPerSecond2, -8'400, 1);
}

TEST(PlanFastest, OneStepIsAMove) {
    const Profile p = fastest(1, limits(500, 6'000, 4'200, 4'200));
    EXPECT_EQ(p.phases.back().to, Displacement::steps(1));
    EXPECT_LE(p.duration().ceil().value, 2'003);
}

TEST(PlanFastest, TwoToTheFortyStepsEndExactly) {
    const std::int64_t n = std::int64_t{1} << 40;
    const Profile p = fastest(n, limits(1'000, 499'999, 1e5, 2e5));
    Position at = Position::steps(0);
    for (const Piece& piece : pieces_of(p, at, +1)) { at = at + piece.covered(); }
    EXPECT_EQ(at.count(), n);
    EXPECT_LT(std::abs((at - Position::steps(n)).as_steps()), 1e-4);
}

TEST(PlanFastest, ItsPiecesReachAnEndWithinATick) {
    const PathLimits l = limits(500, 6'000, 4'200, 4'200);
    for (std::int64_t steps = 100; steps < 140; ++steps) {
        const Profile p = plan_fastest({{}, Displacement::steps(steps), l.start_velocity, l.start_velocity, l, 1});
        Position at = Position::steps(0);
        Ticks lasts;
        for (const Piece& piece : pieces_of(p, at, +1)) {
            at = at + piece.covered();
            lasts += piece.ticks;
        }
        EXPECT_EQ(lasts, p.duration().ceil());
        EXPECT_LT(std::abs((at - Position::steps(steps)).as_steps()), 1e-6) << steps;
    }
}

TEST(PlanBrakeThrough, TakesAtLeastASubtick) {
    EXPECT_EQ(plan_brake_through({}, Displacement{1}, 0.5, 0.5).duration().value, 1);
}

TEST(PlanFastest, TheProfileIsAnchoredAtBothEndsOfEveryPhase) {
    const Profile p = fastest(12'345, limits(500, 6'000, 4'200, 2'100));
    Subticks clock;
    for (const ProfilePhase& phase : p.phases) {
        EXPECT_EQ(p.at(clock), phase.from);
        clock = clock + phase.duration;
        EXPECT_EQ(p.at(clock), phase.to);
    }
}

TEST(PiecesOf, BackwardMotionMirrorsForwardMotionBitForBit) {
    const Profile p = fastest(777, limits(500, 6'000, 4'200, 2'100));
    const auto forward = pieces_of(p, rest_position(0, false), +1);
    const auto backward = pieces_of(p, rest_position(0, true), -1);
    ASSERT_EQ(forward.size(), backward.size());
    for (std::size_t i = 0; i < forward.size(); ++i) {
        EXPECT_EQ(forward[i].velocity.raw, -backward[i].velocity.raw);
        EXPECT_EQ(forward[i].acceleration.raw, -backward[i].acceleration.raw);
    }
}

// Ranade's motor: starts at 1,000 steps/s, runs up to 5,000, accelerates by 25,000 steps/s^2; half a second is given.
const PathLimits kRanade = limits(1'000, 5'000, 25'000, 25'000);
constexpr Ticks kHalfSecond{500'000};

TEST(PlanInTime, AFeasibleMoveIsATriangle) {
    const auto p = plan_in_time(Displacement::steps(1'200), kHalfSecond, kRanade);
    ASSERT_TRUE(p.has_value());
    EXPECT_EQ(p->duration(), subticks(kHalfSecond));
    EXPECT_NEAR(p->peak_velocity() / kPerSecond, 3'800, 0.1);
    EXPECT_NEAR(p->phases[0].acceleration() / kPerSecond2, 11'200, 1);
}

TEST(PlanInTime, UsesATrapezoidIfTheTriangleIsTooFast) {
    const auto p = plan_in_time(Displacement::steps(1'800), kHalfSecond, kRanade);
    ASSERT_TRUE(p.has_value());
    ASSERT_EQ(p->phases.size(), 3u);
    EXPECT_EQ(p->duration(), subticks(kHalfSecond));
    EXPECT_LE(p->peak_velocity(), 5'000 * kPerSecond + 1e-14);
}

TEST(PlanInTime, TheLongestLegalDistanceIsStillLegal) {
    EXPECT_TRUE(plan_in_time(Displacement::steps(1'860), kHalfSecond, kRanade).has_value());
    EXPECT_FALSE(plan_in_time(Displacement::steps(1'861), kHalfSecond, kRanade).has_value());
}

TEST(PlanInTime, ReportsTheFeasibleTimeOfAnInfeasibleMove) {
    const auto p = plan_in_time(Displacement::steps(2'000), kHalfSecond, kRanade);
    ASSERT_FALSE(p.has_value());
    EXPECT_NEAR(p.error().longest.as_steps(), 1'860, 0.01);
    EXPECT_NEAR(static_cast<double>(p.error().least_ticks.value), 528'000, 3);
    EXPECT_TRUE(plan_in_time(Displacement::steps(2'000), p.error().least_ticks + Ticks{2}, kRanade).has_value());
}

TEST(PlanInTime, ASlowMoveRunsAtConstantSpeedBelowTheStartVelocity) {
    const auto p = plan_in_time(Displacement::steps(100), kHalfSecond, kRanade);
    ASSERT_TRUE(p.has_value());
    EXPECT_EQ(p->phases.size(), 1u);
    EXPECT_EQ(p->duration(), subticks(kHalfSecond));
}

TEST(PlanInTime, NoTimeIsInfeasible) {
    EXPECT_FALSE(plan_in_time(Displacement::steps(1), Ticks{0}, kRanade).has_value());
}

}  // namespace
}  // namespace lockstep
