// A move of one axis by itself, as frames for its device. Each frame has a tail from its end to rest.
//
// A device that gets no further frame in time runs the tail of the last one. It comes to rest within limits, not beyond
// the move's end: on a whole step if it reaches one soon, otherwise between two steps. So an axis's process may stall,
// and a move may be halted at any frame, within the same time at every speed.
#pragma once

#include "core/axis/device/held_frames.hpp"
#include "core/axis/own_moves/own_pieces.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {

class OwnMove {
public:
    struct Place {
        Position from;  // at rest
        bool backward = false;
        std::int64_t steps = 0;  // > 0
        Tick start;
    };
    /// How long frames are: at most three times as long as `span`, and so many pieces in the body. A tail lasts at most
    /// `to_whole_step` longer than braking does.
    struct Lengths {
        Ticks span;
        Ticks to_whole_step;
        std::size_t body_pieces = kMostOwnBodyPieces;
    };
    OwnMove(OwnPieces pieces, const Place& place, const AxisLimits& limits, const Lengths& lengths);

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
    Lengths lengths_;
    FrameNumber made_ = 0;
    Tick end_;
    Position at_;
    Displacement gone_;   // forward
    double speed_ = 0;    // at the end of the last body, steps per tick
    double fastest_ = 0;  // the earlier speeds after the greatest deceleration until then: their maximum
};

}  // namespace lockstep
