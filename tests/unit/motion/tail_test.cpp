// The end of a tail. The tests of the planners check the tails of whole paths.
#include <gtest/gtest.h>

#include "core/motion/profile.hpp"

namespace lockstep {
namespace {

/// The tail brakes to zero speed in at least two ticks. A jump to rest would add up with the jump of a corner just
/// after.
TEST(Tail, EndsOnAWholeTickWithoutAJump) {
    const Subticks corner{12 * kSubticksPerTick + 40'000};
    const Profile hardly = plan_brake_to({}, 1e-7, 1e-6, corner);
    EXPECT_EQ(corner + hardly.duration(), subticks(Ticks{15}));
    EXPECT_NEAR(hardly.velocity_at(hardly.duration()), 0, 1e-9);
    const Profile more = plan_brake_to({}, 1e-3, 1e-6, corner);
    EXPECT_EQ(corner + more.duration(), subticks(Ticks{1013}));
    EXPECT_NEAR(more.velocity_at(more.duration()), 0, 1e-9);
    EXPECT_GE(more.phases[0].acceleration(), -1e-6);
}

}  // namespace
}  // namespace lockstep
