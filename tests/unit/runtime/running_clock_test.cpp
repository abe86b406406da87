// A client's own stall does not count as the coordinator's silence.
#include "services/runtime/running_clock.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

using namespace std::chrono_literals;

TEST(RunningClock, CountsTheTimeOfItsLooks) {
    RunningClock clock;
    for (int i = 0; i < 40; ++i) { clock.look(i * 100ms, (i + 1) * 100ms, 100ms); }
    EXPECT_EQ(clock.passed(), 4s);
    EXPECT_FALSE(clock.stall());
}

TEST(RunningClock, LeavesOutAStallWithinALookAndReportsItOnce) {
    RunningClock clock;
    clock.look(0s, 100ms, 100ms);
    clock.look(100ms, 12'200ms, 100ms);  // stopped for 12 s
    EXPECT_EQ(clock.passed(), 100ms + 600ms) << "less than any silence that counts";
    ASSERT_TRUE(clock.stall());
    EXPECT_EQ(clock.stall()->lasted, 11'500ms);
    EXPECT_EQ(clock.stall()->end, 12'200ms);
    clock.forget_stall();
    clock.look(12'200ms, 12'300ms, 100ms);
    EXPECT_FALSE(clock.stall());
    EXPECT_EQ(clock.passed(), 800ms);
}

TEST(RunningClock, CountsLittleOfTheWorkBetweenTwoLooks) {
    RunningClock clock;
    clock.look(0s, 50ms, 50ms);
    clock.look(80ms, 100ms, 50ms);
    EXPECT_EQ(clock.passed(), 100ms);
    clock.look(9s, 9s + 50ms, 50ms);  // a stall, or a long plan
    EXPECT_EQ(clock.passed(), 250ms);
}

TEST(RunningClock, AWaitThatWakesALittleLateCountsAsAWhole) {
    RunningClock clock;
    clock.look(0s, 500ms, 50ms);
    EXPECT_EQ(clock.passed(), 500ms);
    EXPECT_FALSE(clock.stall());
}

}  // namespace
}  // namespace lockstep
