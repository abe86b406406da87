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
    for (const int entries : {kLeastSegmentEntries, 64, 100, 256, 1024, 4096}) {
        for (int stall = 1; stall <= 200; ++stall) {
            ProtocolTiming t = with_least_times(
                {.stall_slots = stall, .late_check_slots = std::min(stall, 2), .segment_entries = entries});
            t.frame_slots = least_frame_slots(t);
            EXPECT_LE(needed_entries(t), entries) << stall;
            EXPECT_GE(body_pieces(t) + tail_pieces(t), kLeastFramePieces) << stall;
            if (t.frame_slots == 1) { continue; }
            --t.frame_slots;
            EXPECT_TRUE(frame_pieces(t) < kLeastFramePieces || frames_ahead(t) > kMostFramesAhead) << stall;
        }
    }
}

/// Motion on large devices stays as it was when every device had 1024 entries.
TEST(FrameRoom, OfALargeRingHasTheLongestTails) {
    for (int stall = 1; stall <= 200; ++stall) {
        const ProtocolTiming t = with_least_times({.stall_slots = stall, .late_check_slots = std::min(stall, 2)});
        EXPECT_EQ(tail_pieces(t), 60) << stall;
        EXPECT_GE(body_pieces(t), 32) << stall;
    }
}

TEST(FrameRoom, OfASmallRingIsSharedByBodyAndTail) {
    ProtocolTiming t = kQuiet;
    t.segment_entries = 108;  // four frames of 27 entries, of which 24 are pieces
    EXPECT_EQ(needed_entries(t), 108);
    EXPECT_EQ(tail_pieces(t), 15);
    EXPECT_EQ(body_pieces(t), 9);
    EXPECT_EQ(least_frame_slots(t), kQuiet.frame_slots - 1);
    t.segment_entries = kLeastSegmentEntries;
    EXPECT_EQ(least_frame_slots(t), kQuiet.send_ahead_slots);
}

TEST(FrameRoom, OfASmallRingLetsAMoveOfAnAxisKeepFourFramesInIt) {
    for (const int entries : {kLeastSegmentEntries, 64, 255, 256, 1024}) {
        const std::size_t frame = kFrameHeaders + own_body_pieces({.segment_entries = entries}) + 1;
        EXPECT_LE(4 * frame, static_cast<std::size_t>(entries));
    }
    EXPECT_EQ(own_body_pieces({}), kMaxBodyPieces + 1);
}

TEST(FrameRoom, OfASmallOutputRingIsSharedByBodyAndTail) {
    ProtocolTiming t = kQuiet;
    t.output_entries = 64;
    EXPECT_EQ(output_room(t).body, 8u);
    EXPECT_EQ(output_room(t).tail, 8u);
    EXPECT_EQ(output_room(kQuiet).tail, OutputTrack::kMostInTail);
}

}  // namespace
}  // namespace lockstep
