// D. Carrica, M. A. Funes, S. A. González, "Novel stepper motor controller based on FPGA hardware implementation": the
// quantised profile of Fig. 4, the continuous one of Fig. 7, and the off-line table of Section I.A beside both.
//
// Fig. 4 has only the numbers n = 7 ... 1. The text gives no numbers for Fig. 7. The tests state the values that they
// assume.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/methods/carrica.hpp"
#include "core/methods/carrica_off_line.hpp"
#include "core/motion/ideal.hpp"

namespace lockstep::methods {
namespace {

/// Fig. 4: V_max is one step per clock period, V_min a seventh of it.
constexpr double kClock4_s = 1.0 / 1024;
constexpr StepMove kFigure4{2'000, 1024.0 / 7, 1024, 900, 900};

/// Fig. 7: "high speeds with full step". The motor of Fig. 6 up to 20,000 steps/s, which is 50 turns/s.
constexpr double kClock7_s = 800e-9;
constexpr StepMove kFigure7{60'000, 500, 20'000, 20'000, 20'000};

std::vector<double> waits(const StepTrain& train) {
    std::vector<double> waits;
    double before = 0;
    for (const double time_s : train.times_s) {
        waits.push_back(time_s - before);
        before = time_s;
    }
    return waits;
}

/// A stretch of equal waits of n clock periods, and when it begins.
struct Level {
    std::int64_t n;
    double from_s;
};

std::vector<Level> levels(const StepTrain& train, double clock_s) {
    std::vector<Level> found;
    double now_s = 0;
    for (const double wait : waits(train)) {
        const std::int64_t n = std::llround(wait / clock_s);
        if (found.empty() || found.back().n != n) { found.push_back({n, now_s}); }
        now_s += wait;
    }
    return found;
}

TEST(CarricaFigure4, WhileAcceleratingTheSpeedIsVmaxOver7Then6And5DownTo1) {
    const auto train = carrica(kFigure4, Fit::Exact, {.clock_s = kClock4_s});
    ASSERT_TRUE(train.has_value()) << text_of(train.error());
    const auto found = levels(*train, kClock4_s);
    ASSERT_GE(found.size(), 7U);
    for (std::size_t i = 0; i < 7; ++i) { EXPECT_EQ(found[i].n, 7 - static_cast<std::int64_t>(i)); }
    EXPECT_EQ(found.back().n, 7);
}

TEST(CarricaFigure4, NChangesWhereTheReferenceReachesTheNextPossibleSpeed) {
    const auto train = carrica(kFigure4, Fit::Exact, {.clock_s = kClock4_s});
    const auto found = levels(*train, kClock4_s);
    for (std::size_t i = 1; i < 7; ++i) {  // t_1 ... t_6
        const double speed = kFigure4.max / static_cast<double>(found[i].n);
        const double reached_s = (speed - kFigure4.start) / kFigure4.acceleration;
        EXPECT_NEAR(found[i].from_s, reached_s, 7 * kClock4_s) << i;  // within a wait: speed is compared once a step
    }
}

TEST(CarricaFigure4, TheOffLineTableHasTheSameSpeedsButMixesNeighboursToKeepTheMeanOne) {
    const auto train = carrica_off_line(kFigure4, Fit::Exact, {.timer_s = kClock4_s});
    ASSERT_TRUE(train.has_value()) << text_of(train.error());
    EXPECT_GT(levels(*train, kClock4_s).size(), 100U);
    const auto ideal = Ideal(kFigure4).step_times_s(Crossing::Whole);
    for (std::size_t i = 0; i < ideal.size(); ++i) { ASSERT_NEAR(train->times_s[i], ideal[i], 0.501 * kClock4_s); }
}

/// A speed lies below the reference by less than the gap to the next possible speed. During a wait the reference
/// changes by at most the acceleration times the wait. Two neighbouring speeds may differ by at most the sum of both.
TEST(CarricaFigure7, AtHighSpeedTheProfileIsContinuousOverTheWholeRange) {
    const auto train = carrica(kFigure7, Fit::Exact, {.clock_s = kClock7_s});
    ASSERT_TRUE(train.has_value()) << text_of(train.error());
    const auto found = waits(*train);
    for (std::size_t i = 1; i < found.size(); ++i) {
        const auto [shorter, longer] = std::minmax(found[i - 1], found[i]);
        const double gap = 1 / (shorter - kClock7_s) - 1 / shorter;
        ASSERT_LE(1 / shorter - 1 / longer, kFigure7.acceleration * longer + gap) << i;
    }
    const double top = 1 / *std::ranges::min_element(found);
    EXPECT_NEAR(top, 20'000, carrica_speed_gap(20'000, kClock7_s));
    EXPECT_LT(carrica_speed_gap(20'000, kClock7_s), 0.02 * 20'000);  // the coarsest gap of the profile: 310 steps/s
}

TEST(CarricaFigure7, TheOffLineTableIsWithinHalfACountOfTheIdealAndTheComparatorEndsLate) {
    const auto table = carrica_off_line(kFigure7, Fit::Exact, {.timer_s = kClock7_s});
    const auto comparator = carrica(kFigure7, Fit::Exact, {.clock_s = kClock7_s});
    const auto ideal = Ideal(kFigure7).step_times_s(Crossing::Whole);
    for (std::size_t i = 0; i < ideal.size(); ++i) { ASSERT_NEAR(table->times_s[i], ideal[i], 0.501 * kClock7_s) << i; }
    const double late_s = comparator->times_s.back() - ideal.back();
    EXPECT_GT(late_s, 100 * kClock7_s);
    EXPECT_LT(late_s, 0.01 * ideal.back());
}

TEST(CarricaOffLine, TheMemoryGrowsWithTheLengthOfTheMove) {
    const auto bytes = [](const StepMove& move, double timer_s) {
        return carrica_table(move, {.timer_s = timer_s})->size() * sizeof(CarricaTable::value_type);
    };
    EXPECT_EQ(bytes({12'000, 500, 6'000, 4'200, 4'200}, 800e-9), 48'000U);       // Fig. 6
    EXPECT_EQ(bytes({700'000, 500, 50'000, 5'000, 5'000}, 400e-9), 2'800'000U);  // Fig. 8
}

TEST(CarricaOffLine, RefusesAStepShorterThanACountWithAReason) {
    const auto train = carrica_off_line({100, 0, 2e6, 4'200, 4'200}, Fit::Nearest);
    ASSERT_FALSE(train.has_value());
    EXPECT_EQ(train.error().why, StepError::Why::TooFast);
}

/// Section II: 6 us give a quantisation "level of 2000 steps" around 15,000 steps/s. By Eq. (10) they do not.
TEST(CarricaSection2, At6usTheGapsAround15000Are1263And1515AndExceed2000OnlyAbove18500) {
    constexpr double kSoftware_s = 6e-6;
    const auto possible = [](int n) { return 1 / (n * kSoftware_s); };
    EXPECT_NEAR(possible(11) - possible(12), 1'263, 0.5);  // 13,889 to 15,152
    EXPECT_NEAR(possible(10) - possible(11), 1'515, 0.5);  // 15,152 to 16,667
    EXPECT_LT(possible(9) - possible(10), 2'000);          // 16,667 to 18,519
    EXPECT_GT(possible(8) - possible(9), 2'000);           // 18,519 to 20,833
    for (const double speed : {13'889.0, 14'500.0, 15'000.0, 15'151.0, 16'000.0, 16'666.0}) {
        EXPECT_LT(carrica_speed_gap(speed, kSoftware_s), 2'000) << speed;
    }
}

}  // namespace
}  // namespace lockstep::methods
