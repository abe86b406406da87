// Frames in a ring, found by their numbers.
#include "core/axis/device/held_frames.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(HeldFrames, FindsEachFrameWhileFramesComeAndGo) {
    HeldFrames frames(3);
    for (FrameNumber k = 1; k <= 100; ++k) {
        frames.push_back({.number = k});
        frames.forget_before(k < 2 ? 1 : k - 1);
        EXPECT_EQ(frames.back().number, k);
        EXPECT_EQ(frames.find(k)->number, k);
        EXPECT_EQ(frames.find(k + 1), nullptr);
    }
    EXPECT_EQ(frames.front().number, 99u);
    EXPECT_EQ(frames.size(), 2u);
}

TEST(HeldFrames, GrowsWhenItIsFull) {
    HeldFrames frames(2);
    for (FrameNumber k = 1; k <= 9; ++k) {
        frames.push_back({.number = k});
        if (k == 1) { frames.forget_before(2); }  // the ring does not begin at its first place
    }
    for (FrameNumber k = 2; k <= 9; ++k) { EXPECT_EQ(frames.find(k)->number, k); }
    EXPECT_EQ(frames.size(), 8u);
}

}  // namespace
}  // namespace lockstep
