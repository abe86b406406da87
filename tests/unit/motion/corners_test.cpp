// Corners that follow each other closely: together they stay within the limits of each axis.
#include "core/motion/corners.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/motion/interpolate.hpp"
#include "core/motion/lookahead.hpp"
#include "core/motion/strain.hpp"
#include "tests/unit/motion/scale.hpp"

namespace lockstep {
namespace {

constexpr double kTick_s = 1e-6;
constexpr double kStart_mm_s = 5;
constexpr double kTop_mm_s = 100;
constexpr double kAccel_mm_s2 = 1000;
constexpr double kSpeed = kStepsPerMm * kTick_s;  // mm/s to steps per tick
const AxisLimits kAxis{kStart_mm_s * kSpeed,          kTop_mm_s* kSpeed, kAccel_mm_s2* kSpeed* kTick_s,
                       kAccel_mm_s2* kSpeed* kTick_s, -10'000'000,       10'000'000};
const std::vector<AxisLimits> kLimits(2, kAxis);
constexpr PathBounds kBounds{Ticks{200}, 28};

Path through(const std::vector<AxisCounts>& places) {
    std::vector<PathMove> moves;
    for (std::size_t i = 1; i < places.size(); ++i) {
        moves.push_back(make_move(places[i - 1], places[i], kLimits, kScale, 0));
        if (moves.back().lead == 0) { moves.pop_back(); }
    }
    return plan_path(moves, {}, kLimits, kBounds);
}

/// The most strain of either axis anywhere on the way, in start velocities.
double most_strain(const Path& path) {
    std::vector<Position> at{start_of(path, 0, path.moves[0].from[0]), start_of(path, 1, path.moves[0].from[1])};
    std::vector<Piece> pieces(2);
    std::vector<Strain> strain(2);
    std::vector<double> speed(2);
    double most = 0;
    PieceSource source(path, Ticks{0}, path.duration().ceil(), at);
    while (source.next(pieces)) {
        for (std::size_t i = 0; i < 2; ++i) {
            const double a = pieces[i].acceleration.steps_per_tick2();
            const double v0 = pieces[i].velocity.steps_per_tick() + a / 2;
            const auto ticks = static_cast<double>(pieces[i].ticks.value);
            strain[i].add(v0 - speed[i], 0, 0);
            most = std::max(most, strain[i].most());
            speed[i] = v0 + a * ticks;
            strain[i].add(speed[i] - v0, ticks, kAxis.max_acceleration);
        }
    }
    return most / kAxis.start_velocity;
}

double fastest_mm_s(const Path& path) {
    double fastest = 0;
    for (const PathMove& move : path.moves) {
        fastest = std::max(fastest, move.profile.peak_velocity() * move.mm_per_lead());
    }
    return fastest / kTick_s;
}

std::vector<AxisCounts> circle(double radius_mm, double chord_mm) {
    std::vector<AxisCounts> places;
    const int n = static_cast<int>(2 * std::numbers::pi * radius_mm / chord_mm);
    for (int i = 0; i <= n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        places.push_back({std::llround(radius_mm * kStepsPerMm * std::cos(angle)),
                          std::llround(radius_mm * kStepsPerMm * std::sin(angle))});
    }
    return places;
}

constexpr double kWhole = 1 + 1e-3;

TEST(Corners, OfAFinelyCutCircleKeepItsCentripetalAccelerationWithinLimits) {
    constexpr double kRadius_mm = 10;
    const Path path = through(circle(kRadius_mm, 0.5));
    EXPECT_LE(most_strain(path), kWhole);
    const double speed = fastest_mm_s(path);
    EXPECT_LE(speed * speed / kRadius_mm, kAccel_mm_s2);
    EXPECT_GE(speed * speed / kRadius_mm, 0.5 * kAccel_mm_s2) << "not slower than necessary";
}

TEST(Corners, EachWithinTheStartVelocityDoNotAddUpBeyondIt) {
    for (const double chord_mm : {0.03, 0.1, 0.3, 1.0, 3.0}) {
        EXPECT_LE(most_strain(through(circle(2, chord_mm))), kWhole) << chord_mm << " mm";
    }
}

/// At lower speed the corners cost less, and the machine may brake harder.
TEST(Corners, OfACurveDoNotMakeAStopMuchLongerThanOnALine) {
    const Path path = through(circle(10, 0.5));
    const Subticks middle = subticks(Ticks{path.duration().floor().value / 2});
    const Path tail = brake_from(path, middle, kLimits);
    const PathMove& first = tail.moves.front();
    const double speed_mm_s = first.profile.velocity_at({}) * first.mm_per_lead() / kTick_s;
    const double seconds = static_cast<double>(tail.duration().ceil().value) * kTick_s;
    EXPECT_GT(speed_mm_s, 60);
    EXPECT_LT(seconds, 2 * speed_mm_s / kAccel_mm_s2);
}

TEST(Corners, OfAZigzagKeepTheLimitsWhateverItsPitch) {
    for (const std::int64_t pitch : {1, 3, 10, 40, 200, 2000}) {
        std::vector<AxisCounts> places;
        for (std::int64_t i = 0; i < 60; ++i) { places.push_back({i * pitch, i % 2 * pitch}); }
        EXPECT_LE(most_strain(through(places)), kWhole) << pitch << " steps";
    }
}

TEST(Corners, FarApartCostNoAcceleration) {
    const Path path = through({{0, 0}, {5000, 0}, {5000, 5000}, {0, 5000}});
    for (const PathMove& move : path.moves) {
        EXPECT_EQ(move.limits.max_acceleration, move.own.max_acceleration);
        EXPECT_EQ(move.limits.max_velocity, move.own.max_velocity);
    }
}

TEST(Corners, AStraightLineCutIntoChordsIsAsFastAsInOnePiece) {
    std::vector<AxisCounts> places;
    for (std::int64_t i = 0; i <= 200; ++i) { places.push_back({i * 30, i * 20}); }
    const auto seconds = [](const Path& path) { return static_cast<double>(path.duration().ceil().value) * kTick_s; };
    EXPECT_LE(seconds(through(places)), 1.015 * seconds(through({{0, 0}, {6000, 4000}})))
        << "except for its first jump";
}

TEST(Corners, BesideARestTooShortToPayForTwoJumpsEachIsSmaller) {
    EXPECT_EQ(rest_share(Ticks{10'000}, kLimits), 1);
    EXPECT_NEAR(rest_share(Ticks{2'500}, kLimits), 0.75, 1e-9);  // 5 mm/s at 1000 mm/s^2 take 5000 ticks
    std::vector<PathMove> moves{make_move({0, 0}, {1000, 0}, kLimits, kScale, 0),
                                {.from = {1000, 0}, .to = {1000, 0}, .dwell = Ticks{1}},
                                make_move({1000, 0}, {0, 0}, kLimits, kScale, 0)};
    EXPECT_LE(most_strain(plan_path(moves, {}, kLimits, kBounds)), kWhole);
}

TEST(Strain, CountsJumpsThatFollowEachOtherAndForgetsThemWithTime) {
    Strain strain;
    strain.add(2, 0, 1);
    strain.add(2, 0, 1);
    EXPECT_EQ(strain.most(), 4);
    strain.add(0, 3, 1);
    EXPECT_EQ(strain.most(), 1);
    strain.add(-3, 0, 1);
    EXPECT_EQ(strain.up, 0);
    EXPECT_EQ(strain.down, 3);
}

}  // namespace
}  // namespace lockstep
