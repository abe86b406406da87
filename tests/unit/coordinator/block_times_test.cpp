// The estimated times of the blocks of a program, in bounded memory.
#include "core/coordinator/program/block_times.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/unit/coordinator/long_axes.hpp"

namespace lockstep {
namespace {

BlockTimes of_a_line(int parts) {
    BlockTimes times(two_long_axes());
    const std::array<double, 2> way{200.0 / parts, 0};
    for (int k = 0; k < parts; ++k) { times.add_move(way, 100); }
    times.add_rest();
    return times;
}

TEST(BlockTimes, OfALineAreThatOfItsRiseCruiseAndFall) {
    for (const std::uint32_t parts : {1U, 200U, 4000U}) {
        const BlockTimes times = of_a_line(static_cast<int>(parts));
        EXPECT_NEAR(times.seconds(), 2 + 100.0 / 1500, 1e-3) << parts;
        EXPECT_NEAR(times.seconds_from({parts / 2, {}}), parts == 1 ? times.seconds() : times.seconds() / 2, 1e-3);
        EXPECT_EQ(times.seconds_from({parts + 1, {}}), 0);
    }
}

TEST(BlockTimes, CountDwellsAndTheWayAlongAMove) {
    BlockTimes times(two_long_axes());
    const std::array<double, 2> way{150, 0};
    times.add_move(way, 50);
    times.add_dwell(2);
    EXPECT_NEAR(times.seconds(), 3 + 50.0 / 1500 + 2, 1e-3);
    EXPECT_NEAR(times.seconds_from({0, Displacement::steps(75)}), (3 + 50.0 / 1500) / 2 + 2, 1e-3) << "mm along it";
    EXPECT_NEAR(times.seconds_from({1, {}}), 2, 1e-3);
}

TEST(BlockTimes, KeepABoundedNumberOfMarksOfAnyProgram) {
    constexpr std::uint32_t kParts = 10 * BlockTimes::kMostMarks;
    const BlockTimes times = of_a_line(kParts);
    EXPECT_NEAR(times.seconds(), 2 + 100.0 / 1500, 1e-3);
    for (const std::uint32_t part : {0U, 1000U, kParts / 3, kParts / 2, kParts - 1}) {
        const double left = times.seconds() * (kParts - part) / kParts;
        EXPECT_NEAR(times.seconds_from({part, {}}), left, 1e-3) << part;
    }
}

TEST(BlockTimes, OfALineAreTheSameAlongEveryAxis) {
    for (const std::size_t axis : {0U, 1U}) {
        BlockTimes times(two_long_axes());
        std::array<double, 2> way{};
        way[axis] = 2;
        for (int k = 0; k < 100; ++k) { times.add_move(way, 100); }
        times.add_rest();
        EXPECT_NEAR(times.seconds(), 2 + 100.0 / 1500, 1e-3) << "axis " << axis << ": it rests only at its ends";
    }
}

TEST(BlockTimes, OfALongProgramKnowNoWayAlongAMove) {
    BlockTimes times(two_long_axes());
    const std::array<double, 2> way{1, 0};
    for (std::size_t k = 0; k < BlockTimes::kMostMarks + 1000; ++k) { times.add_move(way, 100); }
    times.add_rest();
    for (const std::uint32_t block : {100U, static_cast<std::uint32_t>(BlockTimes::kMostMarks) + 500}) {
        EXPECT_EQ(times.seconds_from({block, Displacement::steps(1)}), times.seconds_from({block, {}})) << block;
    }
}

TEST(BlockTimes, OfALongProgramAreOfTheRightBlocks) {
    BlockTimes times(two_long_axes());
    times.add_dwell(1);
    times.add_dwell(1);
    for (std::size_t k = 2; k < BlockTimes::kMostMarks; ++k) { times.add_dwell(0); }
    times.add_dwell(4);
    times.add_dwell(0);
    EXPECT_EQ(times.seconds_from({0, {}}), 6);
    EXPECT_EQ(times.seconds_from({1, {}}), 5) << "a mark stands for two blocks now";
    EXPECT_EQ(times.seconds_from({2, {}}), 4);
    EXPECT_EQ(times.seconds_from({BlockTimes::kMostMarks, {}}), 4);
    EXPECT_EQ(times.seconds_from({BlockTimes::kMostMarks + 1, {}}), 2);
}

TEST(BlockTimes, CountNothingForEventsBeforeTheFirstMove) {
    BlockTimes times(two_long_axes());
    times.add_dwell(0);
    const std::array<double, 2> way{200, 0};
    times.add_move(way, 100);
    times.add_rest();
    EXPECT_NEAR(times.seconds(), 2 + 100.0 / 1500, 1e-3);
    EXPECT_EQ(times.seconds_from({0, {}}), times.seconds());
    EXPECT_EQ(times.seconds_from({1, {}}), times.seconds());
}

}  // namespace
}  // namespace lockstep
