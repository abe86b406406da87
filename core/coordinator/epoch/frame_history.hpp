// The tracks of the last frames of an epoch, to tell later where the motors were at a tick.
#pragma once

#include <cstddef>
#include <vector>

#include "core/kinematics/places.hpp"
#include "core/protocol/messages.hpp"
#include "core/reused_queue.hpp"

namespace lockstep {

class FrameHistory {
public:
    /// More frames than can be run before a touch in them is known.
    static constexpr std::size_t kFramesKept = kMaxRests;

    /// The motors rest at `at` until the first frame starts.
    void begin(const MotorPositions& at);
    /// Frames are added in order.
    void add(const Frame& frame);

    /// The exact places of all motors after this tick, if frame `ran` is the last one that was run; 0: none was. Ticks
    /// before the frames that are kept count as the start of these.
    MotorPositions at(Tick tick, FrameNumber ran) const;

private:
    struct Track {
        Position from;
        std::vector<Piece> body;
        std::vector<Piece> tail;
    };
    struct Kept {
        FrameNumber number = 0;
        Tick start;
        Ticks ticks;
        std::vector<Track> tracks;
    };

    MotorPositions rest_;
    ReusedQueue<Kept> frames_;
};

}  // namespace lockstep
