// Jumps of speed that follow each other closely add up.
#include "core/motion/strain.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(Strain, CountsJumpsThatFollowEachOtherAndForgetsThemWithTime) {
    Strain strain;
    strain.add(2, 0, 1);
    strain.add(2, 0, 1);
    EXPECT_EQ(strain.most(), 4);
    strain.add(0, 3, 1);
    EXPECT_EQ(strain.most(), 1);
    strain.add(-3, 0, 1);
    EXPECT_EQ(strain.up, 0);
    EXPECT_EQ(strain.down, 3);
}

}  // namespace
}  // namespace lockstep
