// C.-K. Lai, W.-N. Chien, Y.-T. Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives
// Design": the simulated runs of Figs. 5 to 9.
//
// The paper does not say how m v is rounded to whole pulses. Its figures need two roundings: Fig. 6 needs rounding from
// the start of the move, Fig. 8 rounding in each period. The tests show that neither rounding gives both figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/methods/lai_planner.hpp"

namespace lockstep::methods {
namespace {

constexpr LaiSpeeds kUncapped{.max = 1'000};
constexpr LaiSpeeds kCappedAt3{.max = 3};
constexpr PeriodPulses kFigure8{107, -93};

std::vector<std::int64_t> of_y(const std::vector<PeriodPulses>& periods) {
    std::vector<std::int64_t> pulses;
    for (const PeriodPulses& period : periods) { pulses.push_back(period.y); }
    return pulses;
}

std::int64_t largest_change(const std::vector<std::int64_t>& speeds) {
    std::int64_t before = 0;
    std::int64_t largest = 0;
    for (const std::int64_t speed : speeds) {
        largest = std::max(largest, std::abs(speed - before));
        before = speed;
    }
    return std::max(largest, std::abs(before));
}

TEST(LaiFigure5, AShortMoveIsATriangleUpToTheRootOfItsLength) {
    EXPECT_EQ(plan_long_axis(16, kUncapped), (std::vector<std::int64_t>{1, 2, 3, 4, 3, 2, 1}));
    const auto periods = plan_long_axis(107, kUncapped);
    EXPECT_EQ(*std::ranges::max_element(periods), 10);  // floor(sqrt(107)), Eq. (10)
    EXPECT_EQ(periods.size(), 19U + 7U);                // 1 ... 10 ... 1, and seven single pulses
}

TEST(LaiFigure2, TheMaximumIsReachedInFourPeriods) {
    const auto periods = plan_long_axis(100, LaiSpeeds{});
    EXPECT_EQ((std::vector<std::int64_t>{periods.begin(), periods.begin() + 5}),
              (std::vector<std::int64_t>{1, 2, 3, 4, 4}));
}

TEST(LaiFigure8, RoundingInEachPeriodOverInterpolatesMinus93ToMinus94) {
    const auto periods = plan_two_axes(kFigure8, kUncapped, LaiRounding::InEachPeriod, kUncompensated);
    EXPECT_EQ(total(periods), (PeriodPulses{107, -94}));
}

/// The figure names no V_max, but needs one of at least 9. Only then does the long axis reach the root of its length,
/// or one less.
TEST(LaiFigure8, Minus94NeedsAVmaxOfAtLeast9AndTheDefaultOf4EndsAtMinus84) {
    const auto end_with = [](std::int64_t max) {
        return total(plan_two_axes(kFigure8, {.max = max}, LaiRounding::InEachPeriod, kUncompensated)).y;
    };
    for (std::int64_t max = 1; max <= 8; ++max) { EXPECT_NE(end_with(max), -94) << max; }
    for (std::int64_t max = 9; max <= 100; ++max) { EXPECT_EQ(end_with(max), -94) << max; }
    EXPECT_EQ(end_with(LaiSpeeds{}.max), -84);
}

TEST(LaiFigure9, WithBothCompensationsItEndsAtMinus93WhateverTheVmax) {
    for (std::int64_t max = 1; max <= 100; ++max) {
        EXPECT_EQ(total(plan_two_axes(kFigure8, {.max = max}, LaiRounding::InEachPeriod, {})), kFigure8) << max;
    }
}

TEST(LaiFigure8, TheDerivativeLimitAloneDoesNotHelp) {
    const auto periods =
        plan_two_axes(kFigure8, kUncapped, LaiRounding::InEachPeriod, {.derivative = true, .remaining = false});
    EXPECT_EQ(total(periods).y, -94);
}

TEST(LaiFigure9, WithBothCompensationsItEndsAtMinus93) {
    const auto periods = plan_two_axes(kFigure8, kUncapped, LaiRounding::InEachPeriod, {});
    EXPECT_EQ(total(periods), kFigure8);
    EXPECT_LE(largest_change(of_y(periods)), 1);
}

TEST(LaiFigure6, WithAtMost3PulsesAPeriodTheShortAxisChangesSuddenlyByTwo) {
    const auto y = of_y(plan_two_axes({25, 20}, kCappedAt3, LaiRounding::FromTheStart, kUncompensated));
    EXPECT_EQ((std::vector<std::int64_t>{y.begin(), y.begin() + 4}), (std::vector<std::int64_t>{1, 1, 3, 2}));
    EXPECT_EQ(largest_change(y), 2);  // counted from rest, between the sampling instants 3 and 4
}

/// This shows that Fig. 6 cannot come from the rounding that Fig. 8 needs.
TEST(LaiFigure6, RoundingInEachPeriodNeverChangesTheShortAxisByMoreThanOne) {
    for (std::int64_t x = 1; x <= 120; ++x) {
        for (std::int64_t y = 0; y <= x; ++y) {
            const auto periods = plan_two_axes({x, y}, kCappedAt3, LaiRounding::InEachPeriod, kUncompensated);
            ASSERT_LE(largest_change(of_y(periods)), 1) << x << ", " << y;
        }
    }
}

/// This shows that the -94 of Fig. 8 cannot come from the rounding of Fig. 6: rounded from the start, every line ends
/// exactly.
TEST(LaiFigure8, RoundingFromTheStartDoesNotOverInterpolate) {
    for (std::int64_t max = 1; max <= 12; ++max) {
        const auto periods = plan_two_axes(kFigure8, {.max = max}, LaiRounding::FromTheStart, kUncompensated);
        EXPECT_EQ(total(periods), kFigure8) << max;
    }
}

TEST(LaiFigure7, TheDerivativeLimitRemovesTheSuddenChange) {
    const auto periods = plan_two_axes({25, 20}, kCappedAt3, LaiRounding::FromTheStart, {});
    const auto y = of_y(periods);
    EXPECT_EQ((std::vector<std::int64_t>{y.begin(), y.begin() + 4}), (std::vector<std::int64_t>{1, 1, 2, 3}));
    EXPECT_LE(largest_change(y), 1);
    EXPECT_EQ(total(periods), (PeriodPulses{25, 20}));
}

/// Checks both compensations for every pair of lengths up to 60 and both roundings.
TEST(LaiCompensations, EveryLineEndsExactlyNoSpeedPassesVmaxOrChangesByMoreThanOne) {
    for (const LaiRounding rounding : {LaiRounding::InEachPeriod, LaiRounding::FromTheStart}) {
        for (std::int64_t x = 0; x <= 60; ++x) {
            for (std::int64_t y = -60; y <= 60; ++y) {
                if (x == 0 && y == 0) { continue; }
                const auto periods = plan_two_axes({x, y}, kCappedAt3, rounding, {});
                ASSERT_EQ(total(periods), (PeriodPulses{x, y}));
                for (const PeriodPulses& period : periods) {
                    ASSERT_LE(std::abs(period.x), kCappedAt3.max) << x << ", " << y;
                    ASSERT_LE(std::abs(period.y), kCappedAt3.max) << x << ", " << y;
                }
                if (std::abs(y) < x) { ASSERT_LE(largest_change(of_y(periods)), 1) << x << ", " << y; }
            }
        }
    }
}

}  // namespace
}  // namespace lockstep::methods
