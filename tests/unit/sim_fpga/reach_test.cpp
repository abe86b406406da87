// How far an axis can go in the next interval, by which contacts are looked at closely.
#include <gtest/gtest.h>

#include "sim_fpga/contacts/reach.hpp"

namespace lockstep {
namespace {

constexpr Reach kReach{.most = 1, .start = 0.1, .accel = 0.001};

TEST(Reach, FromRestAnAxisGoesAtItsStartVelocityAtOnce) {
    EXPECT_DOUBLE_EQ(kReach.mm(0, Ticks{10}, Ticks{10}), (0.1 + 0.02) * 10);
    EXPECT_DOUBLE_EQ(kReach.mm(0, Ticks{10}, Ticks{200}), (0.1 + 0.21) * 200) << "after a stall it has gained more";
}

TEST(Reach, InMotionAnAxisGoesOnByItsLastSpeedAndNeverFasterThanItMay) {
    EXPECT_DOUBLE_EQ(kReach.mm(0.5, Ticks{10}, Ticks{10}), (0.15 + 0.1 + 0.02) * 10);
    EXPECT_DOUBLE_EQ(kReach.mm(8, Ticks{10}, Ticks{10}), 10);
    EXPECT_DOUBLE_EQ(kReach.mm(0, Ticks{}, Ticks{10}), 10) << "nothing is known of the interval before";
}

TEST(Reach, TheWayOfTwoAxesIsThatOfBothTogether) {
    const Reach both = Reach{.most = 3, .start = 0.3, .accel = 0.03}.with({.most = 4, .start = 0.4, .accel = 0.04});
    EXPECT_DOUBLE_EQ(both.most, 5);
    EXPECT_DOUBLE_EQ(both.start, 0.5);
    EXPECT_DOUBLE_EQ(both.accel, 0.05);
}

}  // namespace
}  // namespace lockstep
