// The device's side of the segment ring: whole frames, checked when they are taken.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "core/protocol/messages.hpp"
#include "core/static_vector.hpp"
#include "core/step/segment.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// One entry as the host wrote it, unchecked.
struct SegmentEntry {
    std::uint64_t run = 0;
    FrameNumber frame = 0;
    std::uint64_t flags = 0;
    Segment segment;

    bool first() const { return (flags & registers::kSegmentRingFlagsFirst) != 0; }
    bool tail() const { return (flags & registers::kSegmentRingFlagsTail) != 0; }
    bool last_frame() const { return (flags & registers::kSegmentRingFlagsLastFrame) != 0; }
};

/// A frame with pieces that join each other and can be executed: the body's pieces, then the tail's.
struct LoadedFrame {
    FrameNumber number = 0;
    bool last = false;
    std::size_t body_pieces = 0;
    StaticVector<Piece, kMaxBodyPieces + 1 + kMaxTailPieces + 1> pieces;
};

class SegmentRing {
public:
    explicit SegmentRing(RegisterWindow window) : window_(std::move(window)) {}

    /// Entries taken since power-up.
    std::uint64_t taken() const { return tail_; }
    /// The oldest entry. Returns nullopt if the ring is empty, or the host's head is impossible.
    std::optional<SegmentEntry> front() const;
    /// Takes entries off the ring while the oldest is of `run`, or while it is of any other run.
    void drop_run(std::uint64_t run);
    void drop_other_runs(std::uint64_t run);
    /// Takes the oldest entry's frame. Returns false if it does not begin with its first piece, a piece does not start
    /// where and when the one before ends or cannot be executed, or it is too long. `frame` must not be used then.
    [[nodiscard]] bool take_frame(LoadedFrame& frame);

private:
    SegmentEntry entry(std::uint64_t index) const;

    RegisterWindow window_;
    std::uint64_t tail_ = 0;
};

}  // namespace lockstep
