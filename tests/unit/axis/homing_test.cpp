// The homing sequence alone: the step that follows the end of each move.
#include <gtest/gtest.h>

#include "core/axis/own_moves/homing.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

class HomingSequence : public testing::Test {
protected:
    static MotorConfig axis() {
        MotorConfig axis{.name = "X", .steps_per_mm = 100, .position_max_mm = 100};
        axis.max_velocity_mm_s = 50;
        axis.homing = {.search_velocity_mm_s = 10, .latch_velocity_mm_s = 2, .pulloff_mm = 1, .park_mm = 5};
        return axis;
    }
    static LocalEnd closes_at(std::int64_t count) {
        return {.by_trigger = true, .home_closed = true, .count = count, .trigger_count = count};
    }
    static LocalEnd stands_at(std::int64_t count) { return {.count = count}; }

    /// Touches the switch, and pulls off if that is the next step.
    HomingStep touch(std::int64_t count) {
        const HomingStep step = homing.next(closes_at(count));
        return homing.stage() == HomingStage::PullOff ? homing.next(stands_at(count + 100)) : step;
    }

    Homing homing{axis()};
};

TEST_F(HomingSequence, InPlaceTakesWhereItStandsForThePark) {
    MotorConfig still = axis();
    still.homing.way = HomingWay::InPlace;
    const HomingStep step = Homing(still).begin(true, -3000);
    EXPECT_TRUE(step.zeroed && step.done);
    EXPECT_FALSE(step.move);
    EXPECT_EQ(step.zero_count, -3500);
}

TEST_F(HomingSequence, TwoTouchesThatAgreeSetTheZeroAtTheSecond) {
    EXPECT_EQ(homing.begin(false, 0).move->trigger, Trigger::HomeCloses);
    EXPECT_EQ(touch(-700).move->speed_mm_s, 2);
    const HomingStep zero = touch(-701);
    EXPECT_TRUE(zero.zeroed);
    EXPECT_EQ(zero.zero_count, -701);
    EXPECT_EQ(zero.move->steps, 500);
    EXPECT_TRUE(homing.next(stands_at(-201)).done);
}

/// Behind a release the slide is a whole pull-off away, and the motor turns back through its play.
TEST_F(HomingSequence, TheSlowTouchReachesTheSwitchThroughTheWholePlay) {
    for (const bool toward_min : {true, false}) {
        MotorConfig loose = axis();
        loose.homing.toward_min = toward_min;
        loose.backlash = {.steps = 99, .speed_mm_s = 10, .toward_min = toward_min};
        Homing of_loose(loose);
        of_loose.begin(false, 0);
        of_loose.next(closes_at(-700));
        const HomingStep latch = of_loose.next(stands_at(-600));
        EXPECT_EQ(of_loose.stage(), HomingStage::Latch);
        EXPECT_EQ(latch.move->steps, toward_min ? -299 : 299);
    }
}

TEST_F(HomingSequence, TouchesFurtherApartThanTheToleranceAreTriedAgain) {
    homing.begin(false, 0);
    touch(-700);
    EXPECT_FALSE(touch(-697).zeroed) << "3 steps: 0.03 mm, and the tolerance is 0.02";
    EXPECT_EQ(homing.stage(), HomingStage::Latch);
    EXPECT_EQ(touch(-699).zero_count, -699);
}

/// The errors of both touches count, but no more than these.
TEST_F(HomingSequence, TouchesThatAnotherClockTellsOfMayDifferByItsError) {
    const auto closes_about = [](std::int64_t count, std::int64_t error) {
        LocalEnd end = closes_at(count);
        end.trigger_error = error;
        return end;
    };
    homing.begin(false, 0);
    homing.next(closes_about(-700, 4));
    homing.next(stands_at(-600));
    EXPECT_FALSE(homing.next(closes_about(-709, 2)).zeroed) << "9 steps; 4 and 2 are errors, 2 are the tolerance";
    homing.next(stands_at(-609));
    EXPECT_EQ(homing.next(closes_about(-701, 4)).zero_count, -701) << "8 steps";
}

TEST_F(HomingSequence, ASlideThatIsPushedBehindTheTouchIsTouchedAgain) {
    homing.begin(false, 0);
    touch(-700);
    LocalEnd pushed = closes_at(-700);
    pushed.encoder_ahead = 40;
    EXPECT_FALSE(homing.next(pushed).zeroed) << "the switch closed where it did before, and the slide is elsewhere now";
    EXPECT_EQ(homing.stage(), HomingStage::PullOff);
    homing.next({.count = -600, .encoder_ahead = 40});
    LocalEnd again = closes_at(-740);
    again.encoder_ahead = 40;
    EXPECT_FALSE(homing.next(again).zeroed) << "by the count it is another place";
    homing.next({.count = -640, .encoder_ahead = 40});
    EXPECT_EQ(homing.next(again).zero_count, -740);
}

TEST_F(HomingSequence, ASwitchThatClosesSomewhereElseEachTimeIsRefused) {
    homing.begin(false, 0);
    for (const std::int64_t count : {-700, -600, -650}) { EXPECT_FALSE(touch(count).zeroed); }
    EXPECT_EQ(touch(-620).fault, FaultCode::HomeSwitchUnsteady);
    EXPECT_EQ(homing.stage(), HomingStage::Idle);
}

TEST_F(HomingSequence, AToleranceBelowAStepIsAStep) {
    MotorConfig coarse = axis();
    coarse.homing.touch_tolerance_mm = 0.0001;
    homing = Homing(coarse);
    homing.begin(false, 0);
    touch(-700);
    EXPECT_TRUE(touch(-699).zeroed);
}

TEST_F(HomingSequence, WhereTheSecondTouchMissesTheSwitchIsSearchedAnew) {
    homing.begin(false, 0);
    touch(-300);
    const HomingStep missed = homing.next(stands_at(-400));
    EXPECT_EQ(homing.stage(), HomingStage::Search);
    EXPECT_EQ(missed.move->speed_mm_s, 10);
    touch(-700);
    EXPECT_TRUE(touch(-700).zeroed);
}

TEST_F(HomingSequence, TheFourthTouchIsTheLastEvenIfItMisses) {
    homing.begin(false, 0);
    touch(-700);
    touch(-600);
    EXPECT_EQ(homing.next(stands_at(-500)).fault, FaultCode::None);
    EXPECT_EQ(homing.stage(), HomingStage::Search);
    EXPECT_EQ(touch(-700).fault, FaultCode::HomeSwitchUnsteady);
}

TEST_F(HomingSequence, AnAxisThatStartsBehindItsSwitchTouchesItTwiceToo) {
    EXPECT_EQ(homing.begin(true, 0).move->trigger, Trigger::HomeOpens);
    homing.next({.by_trigger = true, .count = 0, .trigger_count = 0});
    homing.next(stands_at(100));
    EXPECT_FALSE(touch(0).zeroed) << "where it opens is not where it closes";
    EXPECT_TRUE(touch(0).zeroed);
}

TEST_F(HomingSequence, ALimitSwitchOnTheWayToTheSwitchEndsIt) {
    homing.begin(false, 0);
    touch(-700);
    EXPECT_EQ(homing.next({.by_limit = true, .count = -800}).fault, FaultCode::HomeSwitchNotFound);
}

TEST_F(HomingSequence, ASwitchThatClosesAgainAfterEachOfSixteenPullOffsIsStuck) {
    ASSERT_EQ(homing.begin(true, 0).move->trigger, Trigger::HomeOpens);
    const LocalEnd opens{.by_trigger = true};
    const LocalEnd closed_again{.home_closed = true};
    for (int pull_off = 1; pull_off <= 16; ++pull_off) {
        ASSERT_EQ(homing.next(opens).fault, FaultCode::None) << pull_off;
        ASSERT_EQ(homing.stage(), HomingStage::PullOff);
        ASSERT_EQ(homing.next(closed_again).move->trigger, Trigger::HomeOpens);
    }
    EXPECT_EQ(homing.next(opens).fault, FaultCode::HomeSwitchStuck);
    EXPECT_EQ(homing.stage(), HomingStage::Idle);
}

}  // namespace
}  // namespace lockstep
