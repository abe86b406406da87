// A move of one axis by itself, as frames for its device. Each frame has a tail from its end to rest.
//
// A device that gets no further frame in time runs the tail of the last one. It comes to rest within limits, not beyond
// the move's end, and on a whole step if that takes little time. A slow axis stops between two steps instead. Its count
// of steps is its position, and its next move begins on that whole step. So an axis's process may stall, and a move may
// be halted at any frame and at any speed.
#pragma once

#include "core/axis/device/held_frames.hpp"
#include "core/axis/own_moves/own_pieces.hpp"

namespace lockstep {

class OwnMove {
public:
    struct Place {
        Position from;  // at rest
        bool backward = false;
        std::int64_t steps = 0;  // > 0
        Tick start;
    };
    /// Frames last little longer than `span`, and have at most as many pieces as a frame holds.
    OwnMove(OwnPieces pieces, const Place& place, const AxisLimits& limits, Ticks span);

    /// By how much a tail may last longer than the deceleration that stops between two steps, in frames.
    static constexpr std::int64_t kTailFrames = 4;

    /// The next frame, numbered from 1. Must not be called when all frames are made.
    HeldFrame next();
    bool none_made() const { return made_ == 0; }
    bool all_made() const { return pieces_.done() || pieces_.broken(); }
    bool broken() const { return pieces_.broken(); }
    /// End of the frames made so far.
    Tick end() const { return end_; }

private:
    void fill_body(HeldFrame& frame);
    void fill_tail(HeldFrame& frame) const;
    Piece directed(const Piece& piece) const;

    OwnPieces pieces_;
    Place place_;
    AxisLimits limits_;
    Ticks span_;
    FrameNumber made_ = 0;
    Tick end_;
    Position at_;
    Displacement gone_;   // forward
    double speed_ = 0;    // at the end of the last body, steps per tick
    double fastest_ = 0;  // the earlier speeds after the greatest deceleration until then: their maximum
};

}  // namespace lockstep
