// The words of a host that runs one frame of one piece.
#pragma once

#include <cstdint>

#include "core/units.hpp"
#include "sim_fpga/registers.hpp"

namespace lockstep::rtl {

/// write(offset, value) gives the device a word. The frame starts at rest at count 0, after tick `start`.
template <typename Write>
void run_one_frame(Write&& write, std::int64_t start, std::uint64_t ticks, std::uint64_t velocity,
                   std::uint64_t acceleration) {
    using namespace registers;
    constexpr std::size_t kHeader = kSegmentRing;
    constexpr std::size_t kPiece = kSegmentRing + kSegmentRingEntryBytes;
    write(kSetupRequest, 1);
    write(kEnable, 1);
    write(kVeto, ~std::uint64_t{0});
    write(kHeader + kSegmentRingHeaderTag, kSegmentRingHeaderTagIsHeader | kSegmentRingHeaderTagLastFrame |
                                               kSegmentRingHeaderTagRun.word(1) | kSegmentRingHeaderTagFrame.word(1));
    write(kHeader + kSegmentRingHeaderStart, static_cast<std::uint64_t>(start));
    write(kHeader + kSegmentRingHeaderCounts, kSegmentRingHeaderCountsBody.word(1));
    write(kHeader + kSegmentRingHeaderPhase, kRestPhase);
    write(kPiece + kSegmentRingPieceTag, kSegmentRingPieceTagTicks.word(ticks));
    write(kPiece + kSegmentRingPieceVelocity, velocity);
    write(kPiece + kSegmentRingPieceAcceleration, acceleration);
    write(kSegmentHead, 2);
    write(kArmed, 1);
    write(kRunRequest, 1);
}

}  // namespace lockstep::rtl
