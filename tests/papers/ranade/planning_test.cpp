// P. Ranade, "Linear motor control without the math", Figs. 2 to 4: the motor of the article (start 1,000 steps/s,
// limit 5,000 steps/s, acceleration limit 25,000 steps/s^2) asked for N steps within half a second, planned as in the
// steps after Fig. 3.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/methods/ranade.hpp"
#include "core/motion/profile.hpp"

namespace lockstep {
namespace {

constexpr double kTick_s = 1e-6;
constexpr PathLimits kMotor{1'000 * kTick_s, 5'000 * kTick_s, 25'000 * kTick_s* kTick_s, 25'000 * kTick_s* kTick_s};
constexpr Ticks kHalfASecond{500'000};

auto plan(std::int64_t steps) { return plan_in_time(Displacement::steps(steps), kHalfASecond, kMotor); }

double top_speed(const Profile& profile) { return profile.peak_velocity() / kTick_s; }
double acceleration(const Profile& profile) { return profile.phases.front().acceleration() / kTick_s / kTick_s; }

TEST(RanadeFigure2, TwelveHundredStepsAreATriangleUpTo3800AtAnAccelerationOf11200) {
    const auto profile = plan(1'200);
    ASSERT_TRUE(profile.has_value());
    EXPECT_EQ(profile->phases.size(), 2U);
    EXPECT_NEAR(top_speed(*profile), 3'800, 0.01);
    EXPECT_NEAR(acceleration(*profile), 11'200, 0.1);
}

TEST(RanadeFigure3, EighteenHundredStepsAreNoTriangleButATrapezoid) {
    const auto profile = plan(1'800);
    ASSERT_TRUE(profile.has_value());
    EXPECT_EQ(profile->phases.size(), 3U);
    EXPECT_NEAR(top_speed(*profile), 5'000, 0.1);
    EXPECT_LT(acceleration(*profile), 25'000);
}

/// Fig. 4 names the waits T_1, T_2 ... between pulses; the text before it takes each wait as 1/speed at its beginning.
/// The engine's waits are exact, so each lies between 1/speed at its beginning and at its end.
TEST(RanadeFigure4, EachWaitLiesBetweenTheReciprocalsOfTheSpeedsAtItsEnds) {
    const StepMove move{1'200, 1'000, 3'800, 11'200, 11'200};
    const auto train = methods::ranade(move, methods::Fit::Exact);
    ASSERT_TRUE(train.has_value()) << text_of(train.error());
    const double top_s = (move.max - move.start) / move.acceleration;
    const auto speed = [&](double time_s) {
        return move.start + move.acceleration * (time_s < top_s ? time_s : 2 * top_s - time_s);
    };
    constexpr double kRounding_s = 2.1e-6;  // each pulse is rounded to a tick
    for (std::size_t i = 1; i < train->times_s.size(); ++i) {
        const double from = train->times_s[i - 1];
        const double to = train->times_s[i];
        const auto [slow, fast] = std::minmax({speed(from), speed(to)});
        EXPECT_LE(to - from, 1 / slow + kRounding_s) << i;
        if (to < top_s || from > top_s) { EXPECT_GE(to - from, 1 / fast - kRounding_s) << i; }
    }
}

TEST(RanadePlanning, TwoThousandStepsAreInfeasibleAndTheErrorNamesThe1860ThatAreFeasible) {
    const auto profile = plan(2'000);
    ASSERT_FALSE(profile.has_value());
    EXPECT_NEAR(profile.error().longest.as_steps(), 1'860, 0.01);  // 2 * 0.16 s * 3,000/s + 0.18 s * 5,000/s
    EXPECT_TRUE(plan(1'860).has_value());
    EXPECT_FALSE(plan(1'861).has_value());
}

TEST(RanadePlanning, AHundredThousandStepsASecondAsTheArticleNeeded) {
    const auto train = methods::ranade({400'000, 1'000, 100'000, 200'000, 200'000}, methods::Fit::Exact);
    ASSERT_TRUE(train.has_value());
    EXPECT_EQ(train->times_s.size(), 400'000U);
    EXPECT_NEAR(train->times_s[200'001] - train->times_s[200'000], 10e-6, 1.01e-6);
}

}  // namespace
}  // namespace lockstep
