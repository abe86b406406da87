// The words of a host that runs one frame.
#pragma once

#include <cstdint>

#include "core/units.hpp"
#include "sim_fpga/registers.hpp"

namespace lockstep::rtl {

/// write(offset, value) gives the device a word. The frame starts at rest at count 0, after tick `start`. It has
/// `pieces` pieces, which are the same.
template <typename Write>
void run_one_frame(Write&& write, std::int64_t start, std::uint64_t ticks, std::uint64_t velocity,
                   std::uint64_t acceleration, std::uint64_t pieces = 1) {
    using namespace registers;
    constexpr std::size_t kHeader = kSegmentRing;
    write(kSetupRequest, 1);
    write(kEnable, 1);
    write(kVeto, ~std::uint64_t{0});
    write(kHeader + kSegmentRingHeaderTag, kSegmentRingHeaderTagIsHeader | kSegmentRingHeaderTagLastFrame |
                                               kSegmentRingHeaderTagRun.word(1) | kSegmentRingHeaderTagFrame.word(1));
    write(kHeader + kSegmentRingHeaderStart, static_cast<std::uint64_t>(start));
    write(kHeader + kSegmentRingHeaderCounts, kSegmentRingHeaderCountsBody.word(pieces));
    write(kHeader + kSegmentRingHeaderPhase, kRestPhase);
    for (std::uint64_t n = 1; n <= pieces; ++n) {
        const std::size_t piece = kSegmentRing + n * kSegmentRingEntryBytes;
        write(piece + kSegmentRingPieceTag, kSegmentRingPieceTagTicks.word(ticks));
        write(piece + kSegmentRingPieceVelocity, velocity);
        write(piece + kSegmentRingPieceAcceleration, acceleration);
    }
    write(kSegmentHead, pieces + 1);
    write(kArmed, 1);
    write(kRunRequest, 1);
}

}  // namespace lockstep::rtl
