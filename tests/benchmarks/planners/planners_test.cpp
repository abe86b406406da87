// Tests the planners on moves with times that are computed by hand, and the measurement of speed changes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "tests/benchmarks/planners/document_block.hpp"
#include "tests/benchmarks/planners/grbl_planner.hpp"
#include "tests/benchmarks/planners/klipper_planner.hpp"
#include "tests/benchmarks/planners/speed_changes.hpp"

namespace lockstep::planners {
namespace {

constexpr double kRapid = std::numeric_limits<double>::infinity();

Limits mill() { return {{{10, 150, 1500}, {10, 150, 1500}, {4, 25, 300}}}; }

StraightMove along_x(double mm, double feed) { return {.direction = {1, 0, 0}, .length_mm = mm, .feed_mm_s = feed}; }
StraightMove along_y(double mm, double feed) { return {.direction = {0, 1, 0}, .length_mm = mm, .feed_mm_s = feed}; }
StraightMove along_z(double mm, double feed) { return {.direction = {0, 0, 1}, .length_mm = mm, .feed_mm_s = feed}; }

using Moves = std::vector<StraightMove>;

Speeds by_klipper(const Moves& moves, double cruise_ratio) {
    KlipperSetup setup = klipper_setup(mill());
    setup.minimum_cruise_ratio = cruise_ratio;
    return plan_by_klipper(moves, setup);
}
Speeds by_grbl(const Moves& moves, std::size_t blocks) {
    return plan_by_grbl(moves, mill(), junction_deviation_mm(mill()), blocks);
}

double klipper_seconds(const Moves& moves, double cruise_ratio = 0.5) {
    return seconds_of(moves, by_klipper(moves, cruise_ratio));
}
double grbl_seconds(const Moves& moves, std::size_t blocks = kAllBlocks) {
    return seconds_of(moves, by_grbl(moves, blocks));
}

TEST(OtherPlanners, TakeTheTimeOfATrapezoidForOneMove) {
    const Moves moves{along_x(100, 100)};
    const double expected = 100.0 / 100 + 100.0 / 1500;
    EXPECT_NEAR(klipper_seconds(moves), expected, 1e-9);
    EXPECT_NEAR(grbl_seconds(moves), expected, 1e-9);
    EXPECT_NEAR(grbl_seconds(moves, kGrblBlocks), expected, 1e-9);
}

TEST(OtherPlanners, KeepTheLimitsOfTheSlowAxis) {
    const Moves moves{along_z(20, 100)};
    const double expected = 20.0 / 25 + 25.0 / 300;
    EXPECT_NEAR(klipper_seconds(moves), expected, 1e-9);
    EXPECT_NEAR(grbl_seconds(moves), expected, 1e-9);
}

TEST(OtherPlanners, KlipperLimitsTheSpeedAlongThePathAndGrblThatOfEachAxis) {
    const double part = std::numbers::sqrt2 / 2;
    const Moves moves{{.direction = {part, part, 0}, .length_mm = 200, .feed_mm_s = kRapid}};
    EXPECT_NEAR(klipper_seconds(moves), 200 / 150.0 + 150.0 / 1500, 1e-9);
    EXPECT_NEAR(grbl_seconds(moves), 200 / (150 / part) + 150.0 / 1500, 1e-9);
}

TEST(OtherPlanners, AShortMoveHasNoCruiseButWithKlippersRatio) {
    const Moves moves{along_x(4, 100)};
    const double expected = 2 * std::sqrt(4.0 / 1500);
    EXPECT_NEAR(grbl_seconds(moves), expected, 1e-9);
    EXPECT_NEAR(klipper_seconds(moves, 0), expected, 1e-9);
    // The peak is the speed that 4 mm allow at half the acceleration. The ramps use the whole one, so half of the way
    // is cruise.
    const double cruise = std::sqrt(4.0 * 750);
    EXPECT_NEAR(klipper_seconds(moves, 0.5), 2 * cruise / 1500 + 2 / cruise, 1e-9);
}

TEST(OtherPlanners, TakeARightAngleAtTheStartVelocity) {
    const Moves moves{along_x(50, 100), along_y(50, 100)};
    const double ramps = 100.0 / 1500 + 90.0 / 1500;
    const double ramps_mm = 100.0 * 100 / 3000 + (100.0 * 100 - 10 * 10) / 3000;
    const double expected = 2 * (ramps + (50 - ramps_mm) / 100);
    EXPECT_NEAR(by_klipper(moves, 0.5)[1].begin2, 100, 1e-9);
    EXPECT_NEAR(by_grbl(moves, kAllBlocks)[1].begin2, 100, 1e-9);
    EXPECT_NEAR(klipper_seconds(moves), expected, 1e-9);
    EXPECT_NEAR(grbl_seconds(moves), expected, 1e-9);
}

TEST(OtherPlanners, RestWhereThePathTurnsBack) {
    const Moves moves{along_x(50, 100), {.direction = {-1, 0, 0}, .length_mm = 50, .feed_mm_s = 100}};
    EXPECT_EQ(by_klipper(moves, 0.5)[1].begin2, 0);
    EXPECT_EQ(by_grbl(moves, kAllBlocks)[1].begin2, 0);
}

TEST(OtherPlanners, KlipperIsSlowerInTheCornersOfAShortMove) {
    // v^2 = a l tan(45 degrees) / 2
    EXPECT_NEAR(by_klipper({along_x(50, 100), along_y(0.1, 100), along_x(50, 100)}, 0.5)[1].begin2, 75, 1e-9);
}

TEST(OtherPlanners, TakeTheSameTimeForALineInParts) {
    const Moves whole{along_x(200, 100)};
    const Moves parts(4000, along_x(0.05, 100));
    EXPECT_NEAR(klipper_seconds(parts), klipper_seconds(whole), 1e-6);
    EXPECT_NEAR(grbl_seconds(parts), grbl_seconds(whole), 1e-6);
}

TEST(OtherPlanners, GrblGoesNoFasterThanItCanStopInItsBuffer) {
    const Moves parts(4000, along_x(0.05, 100));
    const double most2 = 2 * 1500 * 0.05 * (kGrblBlocks - 1);  // the blocks after the one under way
    EXPECT_NEAR(by_grbl(parts, kGrblBlocks)[2000].end2, most2, 1e-6);
    EXPECT_NEAR(grbl_seconds(parts, kGrblBlocks), 200 / std::sqrt(most2), 0.05);
}

TEST(OtherPlanners, SpeedsAreContinuousAndEndAtRest) {
    Moves moves;
    for (int k = 0; k < 1000; ++k) {
        const double angle = 0.9 * std::sin(1.7 * k) + 0.01 * k;
        moves.push_back({{std::cos(angle), std::sin(angle), 0}, 0.1 + 0.09 * std::sin(0.37 * k), 100});
    }
    for (const Speeds& speeds :
         {by_klipper(moves, 0.5), by_klipper(moves, 0), by_grbl(moves, kGrblBlocks), by_grbl(moves, kAllBlocks)}) {
        EXPECT_EQ(speeds.front().begin2, 0);
        EXPECT_EQ(speeds.back().end2, 0);
        for (std::size_t k = 0; k < moves.size(); ++k) {
            const Trapezoid& now = speeds[k];
            ASSERT_GE(now.cruise2, std::max(now.begin2, now.end2) - 1e-9) << k;
            ASSERT_LE(2 * now.cruise2 - now.begin2 - now.end2, 2 * now.acceleration * moves[k].length_mm + 1e-9) << k;
            if (k > 0) { ASSERT_NEAR(now.begin2, speeds[k - 1].end2, 1e-9) << k; }
        }
    }
}

TEST(Arcs, AreCutAsKlipperAndGrblDo) {
    const ArcShape shape{.first = 0, .second = 1, .centre_first_mm = -10};
    const std::vector<double> at{0, 0, 0};
    const ArcPath circle(shape, at, at);
    EXPECT_EQ(chords_of_length(1)(circle), 62);
    EXPECT_EQ(chords_of_length(100)(circle), 1);
    EXPECT_EQ(chords_of_error(0.002)(circle), 157);
}

TEST(SpeedChanges, AStepOfTheStartVelocityIsTheWholeShare) {
    SpeedChanges changes(mill(), {});
    double x = 0;
    for (int n = 0; n < 1000; ++n) { changes.take({x += 10 * kSample_s, 0, 0}); }
    changes.finish();
    EXPECT_NEAR(changes.shares()[0], 10 / (10 + 1500 * 2 * kSample_s), 1e-9);
    EXPECT_NEAR(changes.shares()[2], 10 / (10 + 1500 * 200 * kSample_s), 1e-9);
}

TEST(SpeedChanges, OfATrapezoidAreWithinTheLimits) {
    const Moves moves{along_x(50, 100), along_y(50, 100)};
    const ChangeShares shares = changes_of(moves, by_grbl(moves, kAllBlocks), mill());
    EXPECT_THAT(shares, testing::Each(testing::AllOf(testing::Gt(0.9), testing::Lt(1 + 1e-9))));
}

TEST(SpeedChanges, OfManySmallJointsAddUp) {
    // Joints of 1 mm/s each 0.2 ms: 5000 mm/s^2.
    SpeedChanges changes(mill(), {});
    double x = 0;
    for (int n = 0; n < 200; ++n) { changes.take({x += n / 2 * kSample_s, 0, 0}); }
    EXPECT_LT(changes.shares()[0], 0.2);
    EXPECT_NEAR(changes.shares()[1], 25 / (10 + 1500 * 50 * kSample_s), 1e-9);
}

TEST(DocumentBlock, IsReplacedBetweenItsComments) {
    const std::string document = "before\n" + std::string(kBlockBegin) + "old\n" + std::string(kBlockEnd) + "behind\n";
    const auto changed = with_block(document, "new\n");
    ASSERT_TRUE(changed);
    EXPECT_EQ(block_of(*changed), "new\n");
    EXPECT_THAT(*changed, testing::AllOf(testing::StartsWith("before\n"), testing::EndsWith("behind\n")));
    EXPECT_FALSE(with_block("no comments", "new\n"));
}

TEST(DocumentBlock, DiffersInWordsAndInNumbersBeyondTheTolerance) {
    EXPECT_EQ(first_difference("| a | 10.00 |\n", "| a | 10.04 |\n"), "");
    EXPECT_NE(first_difference("| a | 10.00 |\n", "| a | 10.20 |\n"), "");
    EXPECT_NE(first_difference("| a | 10.00 |\n", "| b | 10.00 |\n"), "");
    EXPECT_NE(first_difference("| a | 1 |\n| b | 1 |\n", "| a | 1 |\n"), "");
}

}  // namespace
}  // namespace lockstep::planners
