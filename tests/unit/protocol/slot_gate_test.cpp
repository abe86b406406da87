// One loop of each slot publishes.
#include "core/protocol/slot_gate.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(SlotGate, LetsTheFirstLoopOfEachSlotThrough) {
    SlotGate gate;
    EXPECT_EQ(gate.missed(7), 0);
    EXPECT_TRUE(gate.enter(7));
    EXPECT_FALSE(gate.enter(7));
    EXPECT_FALSE(gate.enter(6)) << "a clock that was set back";
    EXPECT_TRUE(gate.enter(8));
}

TEST(SlotGate, EntersASlotOnceAndThenTheOneAfter) {
    SlotGate gate;
    EXPECT_EQ(gate.next(7), 7);
    (void)gate.enter(7);
    EXPECT_EQ(gate.next(7), 8);
    EXPECT_EQ(gate.next(8), 8);
    EXPECT_EQ(gate.next(5), 8) << "a clock that was set back";
}

TEST(SlotGate, CountsSlotsWithoutALoop) {
    SlotGate gate;
    (void)gate.enter(7);
    EXPECT_EQ(gate.missed(8), 0);
    EXPECT_EQ(gate.missed(11), 3);
}

}  // namespace
}  // namespace lockstep
