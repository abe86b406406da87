// T. Spielauer, "Linear stepper motor control - A summary": the plans of its "Trajectory planning summary" and the
// waits of its "Time step calculation", with a step length of 1 and a timer of 1 MHz.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/methods/spielauer.hpp"
#include "core/motion/ideal.hpp"

namespace lockstep::methods {
namespace {

constexpr StepMove kLong{4'000, 0, 1'000, 1'000, 1'000};

/// The timer's counts of each step, in order.
std::vector<std::int64_t> spielauer_counts(const StepMove& move, const SpielauerParameters& parameters = {}) {
    std::vector<std::int64_t> counts(static_cast<std::size_t>(move.steps));
    std::ranges::generate(counts, [steps = SpielauerSteps(move, parameters)]() mutable { return steps.next_count(); });
    return counts;
}

TEST(SpielauerPlanning, FourThousandStepsAreATrapezoidOf500And3000And500) {
    EXPECT_EQ(plan_spielauer(kLong), (SpielauerPlan{.rising = 500, .cruising = 3'000, .falling = 500, .peak = 1'000}));
}

TEST(SpielauerPlanning, SixHundredStepsAreATriangleOf300And300) {
    const SpielauerPlan plan = plan_spielauer({600, 0, 1'000, 1'000, 1'000});
    EXPECT_EQ(plan.rising, 300);
    EXPECT_EQ(plan.cruising, 0);
    EXPECT_EQ(plan.falling, 300);
    EXPECT_NEAR(plan.peak, std::sqrt(600'000), 1e-9);
}

TEST(SpielauerPlanning, AStrongerBrakeNeedsFewerSteps) {
    const SpielauerPlan plan = plan_spielauer({400, 0, 1'000, 1'000, 3'000});
    EXPECT_EQ(plan.rising, 300);
    EXPECT_EQ(plan.falling, 100);
}

TEST(SpielauerTiming, TheFirstWaitIs44721CountsRoundedDownAndACruisingOne1000) {
    const auto counts = spielauer_counts(kLong);
    EXPECT_EQ(counts.size(), 4'000U);
    EXPECT_EQ(counts.front(), 44'721);  // of 44,721.36
    EXPECT_EQ(counts[500], 1'000);
    EXPECT_EQ(counts[3'499], 1'000);
}

TEST(SpielauerTiming, TheSecondWaitIsAThirdOfTheFirstWhereItShouldBe414Thousandths) {
    const auto counts = spielauer_counts(kLong);
    EXPECT_EQ(counts[1], 14'907);
    const double exact = (std::sqrt(2.0) - 1) * 44'721.36;
    EXPECT_GT(exact / static_cast<double>(counts[1]), 1.24);
}

TEST(SpielauerTiming, TheFirstDeceleratingWaitTakesTheSmallerRootOfTheMotionEquation) {
    const double v = std::sqrt(600'000);  // the peak; 300 steps up, 100 down
    const auto counts = spielauer_counts({400, 0, 1'000, 1'000, 3'000});
    EXPECT_EQ(counts[300], std::floor(1e6 * (v - std::sqrt(v * v - 2 * 3'000)) / 3'000));
}

TEST(SpielauerCorrection, FirstAndLastFiveWaitsAreLongerByItsFactorsAndNoOther) {
    const auto plain = spielauer_counts(kLong);
    const auto corrected = spielauer_counts(kLong, {.corrected = true});
    ASSERT_EQ(plain.size(), corrected.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const std::size_t from_end = plain.size() - i;
        double factor = 1;
        if (i >= 1 && i <= 5) { factor = 1 + 0.08 / static_cast<double>(i); }
        if (from_end <= 5) { factor = 1 + 0.08 / static_cast<double>(from_end); }
        EXPECT_NEAR(static_cast<double>(corrected[i]), factor * static_cast<double>(plain[i]), 2) << i;
    }
}

/// Largest and rms error of the step times, in us.
struct Errors {
    double largest = 0;
    double rms = 0;
};

Errors errors(bool corrected) {
    const auto train = spielauer(kLong, Fit::Exact, {.corrected = corrected});
    const auto ideal = Ideal(kLong).step_times_s(Crossing::Whole);
    Errors errors;
    for (std::size_t i = 0; i < ideal.size(); ++i) {
        const double error = (train->times_s[i] - ideal[i]) * 1e6;
        errors.largest = std::max(errors.largest, std::abs(error));
        errors.rms += error * error / static_cast<double>(ideal.size());
    }
    errors.rms = std::sqrt(errors.rms);
    return errors;
}

TEST(SpielauerCorrection, TheKnownFlawCosts65MillisecondsIn5SecondsAndTheFactorsTakeATwelfthOffIt) {
    const Errors plain = errors(false);
    const Errors corrected = errors(true);
    EXPECT_NEAR(plain.largest, 65'500, 100);
    EXPECT_NEAR(plain.rms, 19'900, 100);
    EXPECT_NEAR(corrected.largest, 60'700, 100);
    EXPECT_NEAR(corrected.rms, 17'600, 100);
}

TEST(SpielauerTiming, EveryStepIsMadeAndTheWaitsAreTheirSum) {
    for (const std::int64_t n : {1, 2, 3, 7, 400, 600, 4'000}) {
        const StepMove move{n, 0, 1'000, 1'000, 3'000};
        const auto counts = spielauer_counts(move);
        const auto train = spielauer(move, Fit::Exact);
        ASSERT_EQ(train->times_s.size(), static_cast<std::size_t>(n));
        const auto sum = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
        EXPECT_DOUBLE_EQ(train->times_s.back(), static_cast<double>(sum) * 1e-6);
        EXPECT_GT(*std::ranges::min_element(counts), 0);
    }
}

TEST(SpielauerLimits, AStartSpeedIsRefusedOrLeftOut) {
    const StepMove move{100, 500, 1'000, 1'000, 1'000};
    EXPECT_FALSE(spielauer(move, Fit::Exact).has_value());
    EXPECT_NE(spielauer(move, Fit::Nearest)->nearest.find("start speed"), std::string::npos);
}

}  // namespace
}  // namespace lockstep::methods
