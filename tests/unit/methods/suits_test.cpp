// Which method suits which axis, and the message if it does not.
#include "core/methods/suits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/motion/limit_watch.hpp"

namespace lockstep::methods {
namespace {

using testing::HasSubstr;

/// 80 steps/mm: 10 mm/s start velocity, 100 mm/s, 1500 mm/s^2.
constexpr SpeedLimits kBelt{800, 8'000, 120'000, 120'000, 1e-6};

std::string why_not(StepMethod method, const SpeedLimits& limits) {
    const auto result = suits(method, limits);
    return result ? "" : text_of(result.error());
}

SpeedLimits changed(void (*change)(SpeedLimits&)) {
    SpeedLimits limits = kBelt;
    change(limits);
    return limits;
}

TEST(Ranade, SuitsEveryAxisOfTheProduct) {
    EXPECT_EQ(why_not(StepMethod::Ranade, kBelt), "");
    EXPECT_EQ(why_not(StepMethod::Ranade, changed([](auto& l) { l.max = 499'000; })), "");
}

TEST(Spielauer, SuitsThoughItKnowsNoStartSpeed) {
    EXPECT_EQ(why_not(StepMethod::Spielauer, kBelt), "");
    EXPECT_EQ(why_not(StepMethod::Spielauer, changed([](auto& l) { l.deceleration = 60'000; })), "");
}

TEST(Spielauer, DoesNotSuitIfItsFirstWaitsJumpTooFar) {
    // Its second wait is a third of the first: a jump of sqrt(2 a), here 490 steps/s.
    EXPECT_THAT(why_not(StepMethod::Spielauer, changed([](auto& l) { l.start = 50; })),
                HasSubstr("makes a jump of speed of"));
}

TEST(Spielauer, DoesNotSuitIfASlowMoveHasNoRamp) {
    // At 1130 steps/s its ramps have one step. At 1077 steps/s they have none.
    EXPECT_THAT(why_not(StepMethod::Spielauer, {43, 1'130, 580'000, 580'000, 1e-6}),
                HasSubstr("makes a jump of speed of"));
}

TEST(Spielauer, DoesNotSuitSpeedsBeyondItsTimer) {
    EXPECT_THAT(why_not(StepMethod::Spielauer, {800, 1'100'000, 1e8, 1e8, 1e-7}),
                HasSubstr("with the method's clock a step takes at least 1 us"));
}

TEST(Carrica, SuitsOneAccelerationBothWays) {
    EXPECT_EQ(why_not(StepMethod::Carrica, kBelt), "");
    EXPECT_THAT(why_not(StepMethod::Carrica, changed([](auto& l) { l.deceleration = 100'000; })),
                HasSubstr("100000 steps/s^2 must equal the acceleration, 120000"));
}

TEST(Carrica, DoesNotSuitSpeedsBeyondItsClock) {
    EXPECT_THAT(why_not(StepMethod::Carrica, {800, 1'300'000, 1e8, 1e8, 1e-7}),
                HasSubstr("with the method's clock a step takes at least 0.8 us"));
}

TEST(Lai, SuitsWhereItsPulsesComeEvenlyEnough) {
    const SpeedLimits slow = changed([](auto& l) { l.max = 4'000; });
    EXPECT_EQ(why_not(StepMethod::Lai, slow), "");
    // 42 pulses in 256 clocks are 6 or 7 clocks apart: alternately 6564 and 5626 steps/s.
    EXPECT_THAT(why_not(StepMethod::Lai, changed([](auto& l) { l.max = 7'100; })),
                HasSubstr("makes a jump of speed of"));
}

TEST(Lai, IsTriedUpToItsGreatestSpeedWhateverTheDeceleration) {
    // 28 pulses in 256 clocks are 9 or 10 clocks apart: alternately 4376 and 3938 steps/s.
    EXPECT_THAT(why_not(StepMethod::Lai, {300, 4'785, 194'000, 1'940'000, 5e-7}),
                HasSubstr("makes a jump of speed of"));
}

TEST(Lai, DoesNotSuitGentleAxesNorSpeedsItHasNoPulsesFor) {
    EXPECT_THAT(why_not(StepMethod::Lai, changed([](auto& l) { l.deceleration = 23'000; })),
                HasSubstr("at least 23668.6 steps/s^2"));
    EXPECT_THAT(why_not(StepMethod::Lai, changed([](auto& l) { l.max = 40'000; })), HasSubstr("39230.8"));
    EXPECT_THAT(why_not(StepMethod::Lai, {50, 150, 120'000, 120'000, 1e-6}), HasSubstr("153.846"));
}

TEST(Lam, SuitsAnAxisThatItsOwnRampsDoNotHurt) {
    const SpeedLimits slide{1'000, 1'666, 100'000, 100'000, 1e-6};
    EXPECT_EQ(why_not(StepMethod::Lam, slide), "");
}

TEST(Lam, DoesNotSuitIfItsRampsBreakTheLimits) {
    EXPECT_THAT(why_not(StepMethod::Lam, kBelt), HasSubstr("makes a jump of speed of"));
    EXPECT_THAT(why_not(StepMethod::Lam, {1'000, 1'666, 100'000, 90'000, 1e-6}), HasSubstr("must equal"));
}

TEST(ABeltAxis, IsSuitedUpToTheSpeedsThatTheReadmeNames) {
    const auto why_not_at = [](StepMethod method, double mm_s) {
        SpeedLimits limits = kBelt;
        limits.max = 80 * mm_s;
        return why_not(method, limits);
    };
    for (const StepMethod method : {StepMethod::Ranade, StepMethod::Spielauer, StepMethod::Carrica}) {
        EXPECT_EQ(why_not_at(method, 150), "");
    }
    EXPECT_EQ(why_not_at(StepMethod::Lai, 61), "");
    EXPECT_NE(why_not_at(StepMethod::Lai, 62), "");
    EXPECT_EQ(why_not_at(StepMethod::Lam, 24), "");
    EXPECT_NE(why_not_at(StepMethod::Lam, 25), "");
}

TEST(EveryOtherMethod, NeedsThreeTicksAStep) {
    for (const StepMethod method : {StepMethod::Spielauer, StepMethod::Lai, StepMethod::Lam, StepMethod::Carrica}) {
        EXPECT_THAT(why_not(method, changed([](auto& l) { l.max = 400'000; })),
                    HasSubstr("a third of a step per tick"));
    }
}

TEST(LimitWatch, AllowsOneJumpAndAnAcceleration) {
    LimitWatch watch({.start = 100, .acceleration = 1'000, .deceleration = 500});
    EXPECT_FALSE(watch.step(1.0 / 109));  // 9.2 ms: they allow 109 steps/s
    EXPECT_FALSE(watch.step(1.0 / 117));  // 17.7 ms after rest
    const auto breach = watch.step(1.0 / 160);
    ASSERT_TRUE(breach);
    EXPECT_DOUBLE_EQ(breach->allowed, 100);
    EXPECT_GT(breach->change, 100);
}

TEST(LimitWatch, CountsTheRestAtTheEnd) {
    LimitWatch watch({.start = 100, .acceleration = 1'000, .deceleration = 500});
    EXPECT_FALSE(watch.step(1.0 / 100));
    EXPECT_FALSE(watch.rest());
    EXPECT_FALSE(watch.step(1.0 / 108));
    EXPECT_TRUE(watch.rest());
}

}  // namespace
}  // namespace lockstep::methods
