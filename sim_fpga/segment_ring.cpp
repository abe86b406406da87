#include "sim_fpga/segment_ring.hpp"

#include "core/step/executable.hpp"

namespace lockstep {

using namespace registers;

std::optional<SegmentEntry> SegmentRing::front() const {
    const std::uint64_t loaded = window_.load(kSegmentHead) - tail_;
    if (loaded == 0 || loaded > kSegmentRingEntries) { return std::nullopt; }
    return entry(tail_);
}

void SegmentRing::drop_run(std::uint64_t run) {
    for (auto oldest = front(); oldest && oldest->run == run; oldest = front()) { ++tail_; }
}

void SegmentRing::drop_other_runs(std::uint64_t run) {
    for (auto oldest = front(); oldest && oldest->run != run; oldest = front()) { ++tail_; }
}

bool SegmentRing::take_frame(LoadedFrame& frame) {
    const auto first = front();
    if (!first || !first->first() || first->tail()) { return false; }
    frame = {.number = first->frame, .last = first->last_frame()};
    Segment expected = first->segment;
    for (auto next = first; next && next->run == first->run && next->frame == first->frame; next = front()) {
        const Piece& piece = next->segment.piece;
        const bool joins = next->segment.start == expected.start && next->segment.from == expected.from;
        const bool in_order = next->tail() || frame.body_pieces == frame.pieces.size();
        if (!joins || !in_order || piece.ticks < Ticks{1} || !executable(piece) || !frame.pieces.push_back(piece)) {
            return false;
        }
        frame.body_pieces += next->tail() ? 0 : 1;
        expected = {.start = next->segment.end(), .from = next->segment.to(), .piece = {}};
        ++tail_;
    }
    return true;
}

SegmentEntry SegmentRing::entry(std::uint64_t index) const {
    const std::size_t at = kSegmentRing + (index % kSegmentRingEntries) * kSegmentRingEntryBytes;
    const auto word = [&](std::size_t offset) { return window_.load(at + offset); };
    const auto number = [&](std::size_t offset) { return static_cast<std::int64_t>(word(offset)); };
    return {
        .run = word(kSegmentRingRun),
        .frame = word(kSegmentRingFrame),
        .flags = word(kSegmentRingFlags),
        .segment = {.start = {number(kSegmentRingStart)},
                    .from = Position::from_count(number(kSegmentRingCount), word(kSegmentRingPhase)),
                    .piece = {.ticks = {number(kSegmentRingTicks)},
                              .velocity = {number(kSegmentRingVelocity)},
                              .acceleration = {number(kSegmentRingAcceleration)}}},
    };
}

}  // namespace lockstep
