// How many pieces a frame has, so that a device has room for all frames that are sent ahead.
#include <gtest/gtest.h>

#include "core/machine.hpp"
#include "core/motion/moves.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {
namespace {

constexpr ProtocolTiming kQuiet{.slot_us = 1000,
                                .stall_slots = 1,
                                .late_check_slots = 0,
                                .freshness_slots = 2,
                                .send_ahead_slots = 11,
                                .frame_slots = 5};

/// For moves by Lai's method, a frame has the pieces of each move.
TEST(FrameRoom, SetsTheShortestMove) {
    EXPECT_EQ(least_move({.timing = {}}), Ticks{50'000 / 12 + 1});
    EXPECT_EQ(least_move({.timing = kQuiet}), Ticks{5000 / 44 + 1});
}

TEST(FrameRoom, OfTheLeastFrameIsEnoughForWhatIsSentAheadAndNoShorterOneIs) {
    for (int stall = 1; stall <= 200; ++stall) {
        ProtocolTiming t = with_least_times({.stall_slots = stall, .late_check_slots = std::min(stall, 2)});
        t.frame_slots = least_frame_slots(t);
        const auto all = frames_ahead(t) * (1 + body_pieces(t) + static_cast<int>(kMaxTailPieces) + 2);
        EXPECT_LE(all, kDeviceRingEntries) << stall;
        EXPECT_GE(body_pieces(t), kLeastBodyPieces) << stall;
        if (t.frame_slots == 1) { continue; }
        --t.frame_slots;
        EXPECT_TRUE(body_pieces(t) < kLeastBodyPieces || frames_ahead(t) + 2 > int{kMaxFramesKept}) << stall;
    }
}

}  // namespace
}  // namespace lockstep
