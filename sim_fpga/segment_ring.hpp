// The device's side of the segment ring: whole frames, checked when they are taken.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "core/protocol/messages.hpp"
#include "core/static_vector.hpp"
#include "core/step/segment.hpp"
#include "sim_fpga/register_ring.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// What the host wrote at the beginning of a frame, unchecked.
struct FrameHeader {
    std::uint64_t tag = 0;
    Tick start;
    std::uint64_t counts = 0;
    std::uint64_t phase = 0;

    /// Otherwise the entry is a piece, so the ring's order is lost.
    bool is_header() const { return (tag & registers::kSegmentRingHeaderTagIsHeader) != 0; }
    bool is_last_frame() const { return (tag & registers::kSegmentRingHeaderTagLastFrame) != 0; }
    bool is_of_run(std::uint64_t run) const {
        return is_header() && registers::kSegmentRingHeaderTagRun.shows(tag, run);
    }
    bool is_frame(FrameNumber number) const { return registers::kSegmentRingHeaderTagFrame.shows(tag, number); }
    std::uint64_t body_pieces() const { return registers::kSegmentRingHeaderCountsBody.of(counts); }
    std::uint64_t pieces() const { return body_pieces() + registers::kSegmentRingHeaderCountsTail.of(counts); }
    /// The position with its low bits at which the frame starts, of all such positions the nearest to `near_count`.
    Position from(std::int64_t near_count) const;
};

/// A frame with pieces that can be executed: the body's pieces, then the tail's.
struct LoadedFrame {
    FrameNumber number = 0;
    bool last = false;
    std::uint64_t entry = 0;  // its header's place, in entries since power-up
    std::size_t body_pieces = 0;
    StaticVector<Piece, kMaxBodyPieces + 1 + kMaxTailPieces + 1> pieces;
};

class SegmentRing {
public:
    /// entries: a power of two, at most registers::kSegmentRingMostEntries. longest_piece: at most kMaxPieceTicks.
    SegmentRing(RegisterWindow window, std::size_t entries, Ticks longest_piece)
        : window_(std::move(window)),
          ring_(registers::kSegmentRing, entries, registers::kSegmentRingEntryBytes),
          longest_piece_(longest_piece) {}

    /// Entries taken since power-up.
    std::uint64_t taken() const { return tail_; }
    /// The oldest entry. Returns nullopt if the ring is empty, or the host's head is impossible.
    std::optional<FrameHeader> front() const;
    /// Takes frames off the ring while the oldest is of `run`, or while it is of any other run.
    void drop_run(std::uint64_t run);
    void drop_other_runs(std::uint64_t run);
    /// Takes the oldest frame, which has this number, into `frame`. Returns false and takes nothing if it is not whole
    /// or too long, or if a piece cannot be executed. `frame` must not be used then.
    [[nodiscard]] bool take_frame(FrameNumber number, LoadedFrame& frame);

private:
    std::uint64_t loaded() const { return window_.load(registers::kSegmentHead) - tail_; }
    void drop(const FrameHeader& header);
    bool read_piece(std::uint64_t index, Piece& piece) const;

    RegisterWindow window_;
    RegisterRing ring_;
    Ticks longest_piece_;
    std::uint64_t tail_ = 0;
};

}  // namespace lockstep
