#include "sim_fpga/firmware/device/segment_queue.hpp"

namespace lockstep::firmware {

using namespace registers;

namespace {

constexpr Ring kSegments{kSegmentRing, kSegmentRoom, kSegmentRingEntryBytes};

}  // namespace

Place FrameHeader::from(std::int64_t near_count) const {
    const auto its = static_cast<std::uint32_t>(kSegmentRingHeaderCountsCount.of(counts));
    const std::uint32_t ahead = its - static_cast<std::uint32_t>(near_count);
    return {.count = near_count + static_cast<std::int32_t>(ahead), .phase = phase};
}

bool SegmentQueue::front(FrameHeader& header) const {
    if (loaded() == 0 || loaded() > kSegmentRoom) { return false; }
    const std::size_t at = kSegments.entry(tail_);
    header = {.tag = words_.load_within(kSegmentRing, at + kSegmentRingHeaderTag),
              .start = static_cast<std::int64_t>(words_.load_within(kSegmentRing, at + kSegmentRingHeaderStart)),
              .counts = words_.load_within(kSegmentRing, at + kSegmentRingHeaderCounts),
              .phase = words_.load_within(kSegmentRing, at + kSegmentRingHeaderPhase)};
    return true;
}

void SegmentQueue::drop_run(std::uint64_t run) {
    for (FrameHeader oldest; front(oldest) && oldest.is_of_run(run);) { drop(oldest); }
}

void SegmentQueue::drop_other_runs(std::uint64_t run) {
    for (FrameHeader oldest; front(oldest) && !oldest.is_of_run(run);) { drop(oldest); }
}

void SegmentQueue::drop(const FrameHeader& header) {
    const std::uint64_t entries = header.is_header() ? 1 + header.pieces() : 1;
    tail_ += entries < loaded() ? entries : loaded();
}

void SegmentQueue::check_ahead() {
    const std::uint64_t head = words_.load(kSegmentHead);
    if (head - checked_ > kSegmentRoom) { checked_ = head - kSegmentRoom; }
    for (; checked_ != head; ++checked_) {
        const std::size_t at = kSegments.entry(checked_);
        if (is_executable_at(at)) { words_.mark_checked(at); }
    }
}

bool SegmentQueue::take_frame(std::uint64_t number, LoadedFrame& frame) {
    FrameHeader header;
    if (!front(header) || !is_whole(header)) { return false; }
    frame.number = number;
    frame.is_last = header.is_last_frame();
    frame.body_pieces = static_cast<std::size_t>(header.body_pieces());
    frame.size = static_cast<std::size_t>(header.pieces());
    for (std::size_t k = 0; k < frame.size; ++k) { frame.pieces[k] = piece_at(kSegments.entry(tail_ + 1 + k)); }
    tail_ += 1 + header.pieces();
    return true;
}

bool SegmentQueue::is_whole(const FrameHeader& header) const {
    if (header.body_pieces() == 0 || header.pieces() > kMostPieces || header.pieces() >= loaded()) { return false; }
    const auto pieces = static_cast<std::size_t>(header.pieces());
    for (std::size_t k = 1; k <= pieces; ++k) {
        const std::size_t at = kSegments.entry(tail_ + k);
        if (!words_.is_checked(at) && !is_executable_at(at)) { return false; }
    }
    return true;
}

Piece SegmentQueue::piece_at(std::size_t at) const {
    const std::uint64_t tag = words_.load_within(kSegmentRing, at + kSegmentRingPieceTag);
    return {.ticks = static_cast<std::int64_t>(kSegmentRingPieceTagTicks.of(tag)),
            .velocity = words_.load_within(kSegmentRing, at + kSegmentRingPieceVelocity),
            .acceleration = words_.load_within(kSegmentRing, at + kSegmentRingPieceAcceleration)};
}

bool SegmentQueue::is_executable_at(std::size_t at) const {
    const std::uint64_t tag = words_.load_within(kSegmentRing, at + kSegmentRingPieceTag);
    return (tag & kSegmentRingHeaderTagIsHeader) == 0 && is_executable(piece_at(at));
}

}  // namespace lockstep::firmware
