// Proof that another process lives: consecutive current states, not old ones sent again.
#include "core/protocol/second_process.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

constexpr ProtocolTiming kTiming{.slot_us = 1000,
                                 .stall_slots = 1,
                                 .late_check_slots = 0,
                                 .freshness_slots = 2,
                                 .send_ahead_slots = 12,
                                 .frame_slots = 5};
constexpr Slot kNow = 1000;
constexpr int kProof = SecondProcess::kStatesThatProve;

TEST(SecondProcess, IsProvedByTwentyCurrentStatesInARow) {
    SecondProcess second(kTiming);
    for (Slot slot = kNow; slot < kNow + kProof - 1; ++slot) { EXPECT_FALSE(second.proves(7, slot, slot)); }
    EXPECT_TRUE(second.proves(7, kNow + kProof, kNow + kProof));
}

TEST(SecondProcess, IsNotProvedByOldStates) {
    SecondProcess second(kTiming);
    const Slot old = kNow - rules::silence_slots(kTiming) - 1;
    for (Slot slot = 0; slot < 1000; ++slot) { EXPECT_FALSE(second.proves(7, old + slot, kNow + slot)); }
}

TEST(SecondProcess, IsNotProvedByOneStateSentAgain) {
    SecondProcess second(kTiming);
    for (int i = 0; i < 1000; ++i) { EXPECT_FALSE(second.proves(7, kNow, kNow)); }
}

TEST(SecondProcess, IsNotProvedByStatesOfDifferentProcesses) {
    SecondProcess second(kTiming);
    for (Slot slot = kNow; slot < kNow + 1000; ++slot) {
        EXPECT_FALSE(second.proves(static_cast<Identity>(slot % 2), slot, slot));
    }
}

TEST(SecondProcess, IsNotProvedByStatesFromTheFuture) {
    SecondProcess second(kTiming);
    for (Slot slot = kNow; slot < kNow + 1000; ++slot) { EXPECT_FALSE(second.proves(7, slot + 3, slot)); }
}

TEST(SecondProcess, IsProvedDespiteOldStatesInBetween) {
    SecondProcess second(kTiming);
    bool is_proved = false;
    for (Slot slot = kNow; slot < kNow + kProof; ++slot) {
        (void)second.proves(7, slot - 500, slot);
        is_proved = second.proves(7, slot, slot);
    }
    EXPECT_TRUE(is_proved);
}

}  // namespace
}  // namespace lockstep
