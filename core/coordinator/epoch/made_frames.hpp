// The frames of an epoch that were made so far: when each one ends, where it leads, and where the machine rests if it
// is the last one run. Only the newest frames are kept.
#pragma once

#include <array>
#include <optional>

#include "core/coordinator/epoch/epoch_end.hpp"
#include "core/path/frame_planner.hpp"
#include "core/protocol/messages.hpp"
#include "core/reused_queue.hpp"

namespace lockstep {

class MadeFrames {
public:
    /// An epoch begins, at rest.
    void begin(const PathPlace& place, const MotorPositions& at);
    /// Its first frame starts at this tick.
    void start_at(Tick start) { start_ = rests_ = start; }
    /// Frames are added in order. `has_pulses`: devices wait for places if the machine rests after it.
    void add(const Frame& frame, const PathFrame& path, bool has_pulses);

    /// The start of the first frame; empty while that frame cannot be made yet.
    const std::optional<Tick>& start() const { return start_; }
    /// The number of the newest frame; 0: none was made.
    FrameNumber newest() const { return newest_; }
    /// The start of the next frame. The first one has a start.
    Tick next_start() const { return *start_ + frames_.back().end; }
    /// By when the machine rests, whichever of the frames is the last one run.
    Tick rests() const { return rests_; }
    /// The place on the program at `tick`.
    PathPlace place_at(Tick tick) const;
    /// How long the first `frames` frames last.
    Ticks ticks_of(FrameNumber frames) const { return keeps(frames) ? frame(frames).end : Ticks{}; }
    bool keeps(FrameNumber number) const { return number >= oldest() && number <= newest_; }
    /// The end of an epoch of which this kept frame is the last one run.
    EpochEnd end_behind(FrameNumber number) const;
    /// Sets `rests` to where the machine rests after this frame and after each later one.
    void list_rests(FrameNumber first, StaticVector<FrameRest, kMaxRests>& rests) const;

private:
    struct Made {                          // a frame; number 0: the epoch's begin
        Ticks end;                         // from the epoch's start
        std::array<PathPlace, 16> places;  // in equal parts of its time
        PathPlace rest;                    // where the machine rests if it is the last one run
        MotorPositions positions;
        bool complete = false;
        bool has_pulses = false;  // if the machine rests after it
    };

    const Made& frame(FrameNumber number) const { return frames_[number - oldest()]; }
    FrameNumber oldest() const { return newest_ + 1 - frames_.size(); }

    std::optional<Tick> start_;
    Tick rests_;
    FrameNumber newest_ = 0;
    MotorPositions at_;  // behind the newest frame
    ReusedQueue<Made> frames_;
};

}  // namespace lockstep
