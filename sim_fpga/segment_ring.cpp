#include "sim_fpga/segment_ring.hpp"

#include <algorithm>

#include "core/step/executable.hpp"

namespace lockstep {

using namespace registers;

Position FrameHeader::from(std::int64_t near_count) const {
    const auto low = [](std::uint64_t count) { return static_cast<std::uint32_t>(count); };
    const std::uint32_t ahead =
        low(kSegmentRingHeaderCountsCount.of(counts)) - low(static_cast<std::uint64_t>(near_count));
    return Position::from_count(near_count + static_cast<std::int32_t>(ahead), phase);
}

std::optional<FrameHeader> SegmentRing::front() const {
    if (loaded() == 0 || loaded() > ring_.entries()) { return std::nullopt; }
    const std::size_t at = ring_.entry(tail_);
    return FrameHeader{.tag = window_.load(at + kSegmentRingHeaderTag),
                       .start = {static_cast<std::int64_t>(window_.load(at + kSegmentRingHeaderStart))},
                       .counts = window_.load(at + kSegmentRingHeaderCounts),
                       .phase = window_.load(at + kSegmentRingHeaderPhase)};
}

void SegmentRing::drop_run(std::uint64_t run) {
    for (auto oldest = front(); oldest && oldest->is_of_run(run); oldest = front()) { drop(*oldest); }
}

void SegmentRing::drop_other_runs(std::uint64_t run) {
    for (auto oldest = front(); oldest && !oldest->is_of_run(run); oldest = front()) { drop(*oldest); }
}

void SegmentRing::drop(const FrameHeader& header) {
    tail_ += header.is_header() ? std::min(1 + header.pieces(), loaded()) : 1;
}

bool SegmentRing::take_frame(FrameNumber number, LoadedFrame& frame) {
    const auto header = front();
    if (!header || header->body_pieces() == 0 || header->pieces() > frame.pieces.capacity() ||
        header->pieces() >= loaded()) {
        return false;
    }
    frame = {.number = number,
             .last = header->is_last_frame(),
             .entry = tail_,
             .body_pieces = header->body_pieces(),
             .pieces = {}};
    for (std::uint64_t k = 1; k <= header->pieces(); ++k) {
        Piece piece;
        if (!read_piece(tail_ + k, piece)) { return false; }
        frame.pieces.append(piece);
    }
    tail_ += 1 + header->pieces();
    return true;
}

/// Returns false if the entry is none that can be executed.
bool SegmentRing::read_piece(std::uint64_t index, Piece& piece) const {
    const std::size_t at = ring_.entry(index);
    const auto number = [&](std::size_t word) { return static_cast<std::int64_t>(window_.load(at + word)); };
    const std::uint64_t tag = window_.load(at + kSegmentRingPieceTag);
    piece = {.ticks = {static_cast<std::int64_t>(kSegmentRingPieceTagTicks.of(tag))},
             .velocity = {number(kSegmentRingPieceVelocity)},
             .acceleration = {number(kSegmentRingPieceAcceleration)}};
    const bool is_piece = (tag & kSegmentRingHeaderTagIsHeader) == 0;
    return is_piece && piece.ticks >= Ticks{1} && piece.ticks <= longest_piece_ && executable(piece);
}

}  // namespace lockstep
