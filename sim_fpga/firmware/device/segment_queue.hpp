// The device's side of the segment ring: whole frames, checked when they are taken.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/engine.hpp"
#include "sim_fpga/firmware/device/words.hpp"

namespace lockstep::firmware {

/// What the host wrote at the beginning of a frame, unchecked.
struct FrameHeader {
    std::uint64_t tag = 0;
    std::int64_t start = 0;
    std::uint64_t counts = 0;
    std::uint64_t phase = 0;

    /// Otherwise the entry is a piece, so the ring's order is lost.
    bool is_header() const { return (tag & registers::kSegmentRingHeaderTagIsHeader) != 0; }
    bool is_last_frame() const { return (tag & registers::kSegmentRingHeaderTagLastFrame) != 0; }
    bool is_of_run(std::uint64_t run) const {
        return is_header() && registers::kSegmentRingHeaderTagRun.shows(tag, run);
    }
    bool is_frame(std::uint64_t number) const { return registers::kSegmentRingHeaderTagFrame.shows(tag, number); }
    std::uint64_t body_pieces() const { return registers::kSegmentRingHeaderCountsBody.of(counts); }
    std::uint64_t pieces() const { return body_pieces() + registers::kSegmentRingHeaderCountsTail.of(counts); }
    /// The place with its low bits at which the frame starts, of all such places the nearest to `near_count`.
    Place from(std::int64_t near_count) const;
};

/// The body's pieces, then the tail's.
struct LoadedFrame {
    std::uint64_t number = 0;
    bool is_last = false;
    std::size_t body_pieces = 0;
    std::size_t size = 0;
    Piece pieces[kMostPieces]{};
};

class SegmentQueue {
public:
    explicit SegmentQueue(Words& words) : words_(words) {}

    /// Entries taken since power-up.
    std::uint64_t taken() const { return tail_; }
    /// Checks pieces that have been loaded, which takes long. So a frame can be taken in a short time.
    void check_ahead();
    /// Reads the oldest entry. Returns false if the ring is empty, or the host's head is impossible.
    [[nodiscard]] bool front(FrameHeader& header) const;
    /// Takes frames off the ring while the oldest is of `run`, or while it is of any other run.
    void drop_run(std::uint64_t run);
    void drop_other_runs(std::uint64_t run);
    /// Takes the oldest frame, which has this number, into `frame`. Returns false and changes nothing if it is not
    /// whole or too long, or if a piece cannot be executed.
    [[nodiscard]] bool take_frame(std::uint64_t number, LoadedFrame& frame);

private:
    std::uint64_t loaded() const { return words_.load(registers::kSegmentHead) - tail_; }
    void drop(const FrameHeader& header);
    bool is_whole(const FrameHeader& header) const;
    /// The entry at an offset in the window, as a piece.
    Piece piece_at(std::size_t at) const;
    bool is_executable_at(std::size_t at) const;

    Words& words_;
    std::uint64_t tail_ = 0;
    std::uint64_t checked_ = 0;  // entries that were checked ahead
};

}  // namespace lockstep::firmware
