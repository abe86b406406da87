// An encoder that counts the wrong way is told from steps that are lost.
#include "core/axis/state/encoder_watch.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

DeviceStatus at(std::int64_t count, std::int64_t encoder, bool moving) {
    return {.position = Position::steps(count), .moving = moving, .encoder_count = encoder};
}

EncoderWatch after(const DeviceStatus& rest, const DeviceStatus& now) {
    EncoderWatch watch;
    watch.look(rest, false);
    watch.look(now, false);
    return watch;
}

TEST(EncoderWatch, RecognisesAnEncoderThatCountsBack) {
    EXPECT_TRUE(after(at(100, 40, false), at(120, 20, true)).counts_back(16));
    EXPECT_TRUE(after(at(100, 40, false), at(80, 60, true)).counts_back(16));
    EXPECT_TRUE(after(at(100, 40, false), at(120, 21, true)).counts_back(16)) << "it may be behind by a step";
}

TEST(EncoderWatch, WaitsForEnoughSteps) { EXPECT_FALSE(after(at(100, 40, false), at(115, 25, true)).counts_back(16)); }

TEST(EncoderWatch, TakesAnEncoderThatStandsOrLagsForLostSteps) {
    EXPECT_FALSE(after(at(100, 40, false), at(120, 40, true)).counts_back(16));
    EXPECT_FALSE(after(at(100, 40, false), at(120, 55, true)).counts_back(16));
    EXPECT_FALSE(after(at(100, 40, false), at(120, 60, true)).counts_back(16));
}

/// By twice the way of the pulses so far, so that the encoder is where one that counts back would be.
TEST(EncoderWatch, TakesAPushBackInMotionForAPush) {
    EncoderWatch watch = after(at(100, 40, false), at(102, 42, true));
    watch.look(at(120, 20, true), false);
    EXPECT_FALSE(watch.counts_back(2));
    watch.look(at(120, 20, false), false);
    watch.look(at(140, 0, true), false);
    EXPECT_TRUE(watch.counts_back(16)) << "an earlier motion does not count";
}

TEST(EncoderWatch, CountsFromTheLastRestAndFromANewDevice) {
    EncoderWatch watch;
    watch.look(at(0, 0, false), false);
    watch.look(at(20, -20, true), true);
    EXPECT_FALSE(watch.counts_back(16));
    watch.look(at(20, -20, false), false);
    watch.look(at(30, -30, true), false);
    EXPECT_FALSE(watch.counts_back(16));
}

}  // namespace
}  // namespace lockstep
