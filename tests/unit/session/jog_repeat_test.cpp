// The times at which a client sends a jog's command again.
#include "clients/session/control/jog_repeat.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

using namespace std::chrono_literals;

TEST(JogRepeat, APressIsRepeatedInItsPeriod) {
    JogRepeat repeat;
    repeat.note_sent(100s);
    EXPECT_FALSE(repeat.is_due(true, 100s + 4ms));
    EXPECT_EQ(repeat.wake(true, 101s), 100s + 5ms);
    EXPECT_EQ(repeat.wake(true, 100s + 2ms), 100s + 2ms);
    EXPECT_TRUE(repeat.is_due(true, 100s + 5ms));
}

TEST(JogRepeat, WithoutAPressAClientWaitsAsLongAsItIsTold) {
    const JogRepeat repeat;
    EXPECT_FALSE(repeat.is_due(false, 100s));
    EXPECT_EQ(repeat.wake(false, 100s), 100s) << "and does not spin";
}

}  // namespace
}  // namespace lockstep
