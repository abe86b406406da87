// P. Ranade, "Linear motor control without the math": the motor of the article (start 1,000 steps/s, limit 5,000
// steps/s, acceleration limit 25,000 steps/s^2) asked for N steps within half a second, planned as in the steps after
// Fig. 3.
#include <gtest/gtest.h>

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
