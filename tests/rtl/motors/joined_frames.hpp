// The words of a host that runs frames at the greatest speed, a step in each second tick, each joined to the one
// before.
#pragma once

#include <cstdint>

#include "core/units.hpp"
#include "sim_fpga/registers.hpp"

namespace lockstep::rtl {

inline constexpr std::int64_t kJoinedPieces = 2;  // of a frame's body; its tail has one
inline constexpr std::int64_t kJoinedPieceTicks = 10;

/// write(offset, value) gives the device a word. The first frame begins after tick `start`, at rest at count 0. Returns
/// the steps of all frames.
template <typename Write>
std::uint64_t run_joined_frames(Write&& write, std::int64_t start, std::uint64_t frames) {
    using namespace registers;
    constexpr std::uint64_t kVelocity = ~std::uint64_t{0} >> 1;
    write(kSetupRequest, 1);
    write(kEnable, 1);
    write(kVeto, ~std::uint64_t{0});
    std::size_t entry = kSegmentRing;
    std::uint64_t count = 0;
    std::uint64_t phase = kRestPhase;
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        const bool is_last = frame == frames;
        write(entry + kSegmentRingHeaderTag,
              kSegmentRingHeaderTagIsHeader | (is_last ? kSegmentRingHeaderTagLastFrame : 0) |
                  kSegmentRingHeaderTagRun.word(1) | kSegmentRingHeaderTagFrame.word(frame));
        write(entry + kSegmentRingHeaderStart, static_cast<std::uint64_t>(start));
        write(entry + kSegmentRingHeaderCounts, kSegmentRingHeaderCountsCount.word(count) |
                                                    kSegmentRingHeaderCountsBody.word(kJoinedPieces) |
                                                    kSegmentRingHeaderCountsTail.word(is_last ? 0 : 1));
        write(entry + kSegmentRingHeaderPhase, phase);
        entry += kSegmentRingEntryBytes;
        for (std::int64_t piece = 0; piece < kJoinedPieces + (is_last ? 0 : 1); ++piece) {
            write(entry + kSegmentRingPieceTag, kSegmentRingPieceTagTicks.word(kJoinedPieceTicks));
            write(entry + kSegmentRingPieceVelocity, kVelocity);
            write(entry + kSegmentRingPieceAcceleration, 0);
            entry += kSegmentRingEntryBytes;
        }
        for (std::int64_t tick = 0; tick < kJoinedPieces * kJoinedPieceTicks; ++tick) {
            count += phase + kVelocity < phase ? 1 : 0;
            phase += kVelocity;
        }
        start += kJoinedPieces * kJoinedPieceTicks;
    }
    write(kSegmentHead, (entry - kSegmentRing) / kSegmentRingEntryBytes);
    write(kArmed, frames);
    write(kRunRequest, 1);
    return count;
}

}  // namespace lockstep::rtl
