// C.-K. Lai, W.-N. Chien, Y.-T. Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives
// Design": the DDA of Fig. 3, its pulses of Fig. 12, and the six lines of Figs. 14 (without it) and 15 (with it).
#include <gtest/gtest.h>

#include <utility>

#include "core/methods/lai.hpp"
#include "core/methods/lai_dda.hpp"

namespace lockstep::methods {
namespace {

std::vector<int> pulses_of_a_period(Dda& dda, std::int64_t pulses) {
    std::vector<int> clocks;
    dda.load(pulses);
    for (int clock = 1; clock <= kDdaClocks; ++clock) {
        if (dda.clock()) { clocks.push_back(clock); }
    }
    return clocks;
}

TEST(LaiFigure3, APeriodsPulsesAreSpreadEvenlyOverIt) {
    Dda dda;
    EXPECT_EQ(pulses_of_a_period(dda, 4), (std::vector<int>{64, 128, 192, 256}));
    EXPECT_EQ(pulses_of_a_period(dda, 3), (std::vector<int>{86, 171, 256}));
    EXPECT_TRUE(pulses_of_a_period(dda, 0).empty());
}

TEST(LaiFigure3, EveryPeriodMakesExactlyItsPulses) {
    Dda dda;
    for (std::int64_t pulses = 0; pulses <= kMaxPeriodPulses; ++pulses) {
        EXPECT_EQ(pulses_of_a_period(dda, pulses).size(), static_cast<std::size_t>(pulses));
    }
}

TEST(LaiFigure3, APulseIsLessThanOneOf256ClocksBehindAnExactlyEvenSpread) {
    for (std::int64_t pulses = 1; pulses <= kMaxPeriodPulses; ++pulses) {
        Dda dda;
        const auto clocks = pulses_of_a_period(dda, pulses);
        for (std::size_t i = 0; i < clocks.size(); ++i) {
            const double even = 256.0 * static_cast<double>(i + 1) / static_cast<double>(pulses);
            EXPECT_GE(clocks[i], even - 1e-9);
            EXPECT_LT(clocks[i], even + 1);
        }
    }
}

constexpr std::int64_t kPulsesPerUnit = 100;

/// The largest deviation from the line from (from, 0) to (5, 5).
double deviation(std::int64_t from, LaiPulses how) {
    const PeriodPulses end{(5 - from) * kPulsesPerUnit, 5 * kPulsesPerUnit};
    const auto periods = plan_two_axes(end, {}, LaiRounding::FromTheStart, {});
    EXPECT_EQ(total(periods), end);
    return farthest_from_line(walk_two_axes(periods, how), end);
}

/// The ports sAx0Puls and sAx1Puls during line {(1,0), (5,5)}, and the port of the axis that is not in use. The drive
/// makes the phase signals Step0Out and Step1Out from them. Here it takes step and direction.
TEST(LaiFigure12, BothAxesPulseEvenlyThroughEachPeriodAndTheThirdNot) {
    Dda x;
    Dda y;
    Dda third;
    for (const PeriodPulses& period :
         plan_two_axes({4 * kPulsesPerUnit, 5 * kPulsesPerUnit}, {}, LaiRounding::FromTheStart, {})) {
        for (const auto& [dda, pulses] : {std::pair{&x, period.x}, std::pair{&y, period.y}}) {
            const auto clocks = pulses_of_a_period(*dda, pulses);
            ASSERT_EQ(clocks.size(), static_cast<std::size_t>(pulses));
            for (std::size_t i = 1; i < clocks.size(); ++i) {
                EXPECT_NEAR(clocks[i] - clocks[i - 1], static_cast<double>(kDdaClocks) / static_cast<double>(pulses),
                            1);
            }
            if (pulses > 0) { EXPECT_EQ(clocks.back(), kDdaClocks); }
        }
        EXPECT_TRUE(pulses_of_a_period(third, 0).empty());
    }
}

TEST(LaiFigure15, WithTheDdaEveryLineStaysWithinAPulseAndAHalf) {
    for (std::int64_t from = 0; from <= 5; ++from) { EXPECT_LT(deviation(from, LaiPulses::Spread), 1.5) << from; }
}

TEST(LaiFigure14, WithoutTheDdaEveryLineThatIsNotAlongAnAxisIsLessStraight) {
    for (std::int64_t from = 0; from <= 4; ++from) {
        EXPECT_GT(deviation(from, LaiPulses::AtOnce), deviation(from, LaiPulses::Spread)) << from;
    }
    EXPECT_EQ(deviation(5, LaiPulses::AtOnce), 0);
    EXPECT_GT(deviation(0, LaiPulses::AtOnce), 2.5);
}

TEST(LaiFigure14, EitherWayTheSamePulsesAreMade) {
    const auto periods = plan_two_axes({107, -93}, {}, LaiRounding::InEachPeriod, {});
    for (const LaiPulses how : {LaiPulses::Spread, LaiPulses::AtOnce}) {
        const LaiPoint end = walk_two_axes(periods, how).back();
        EXPECT_EQ(end.x, 107);
        EXPECT_EQ(end.y, -93);
    }
}

TEST(LaiMethod, AMoveOfItsOwnKindIsMadeExactly) {
    const double period_s = LaiParameters{}.period_s;
    const StepMove move{4'000, 0, 4 / period_s, 1 / period_s / period_s, 1 / period_s / period_s};
    const auto train = lai(move, Fit::Exact);
    ASSERT_TRUE(train.has_value()) << text_of(train.error());
    EXPECT_EQ(train->times_s.size(), 4'000U);
    EXPECT_NEAR(train->times_s[2'000] - train->times_s[1'999], period_s / 4, 1e-9);
}

TEST(LaiMethod, RefusesImpossibleMovesWithAReason) {
    const StepMove move{12'000, 500, 6'000, 4'200, 4'200};
    EXPECT_NE(lai(move, Fit::Exact).error().nearest.find("whole pulses"), std::string::npos);
    EXPECT_FALSE(lai({12'000, 0, 60'000, 4'200, 4'200}, Fit::Nearest).has_value());  // 390 pulses do not fit 8 bits
    EXPECT_FALSE(lai({12'000, 0, 100, 4'200, 4'200}, Fit::Nearest).has_value());     // not one pulse a period
}

}  // namespace
}  // namespace lockstep::methods
