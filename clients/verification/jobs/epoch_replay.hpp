// Makes the frames of one epoch again by the coordinator's own planning, and evaluates how the epoch ended.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/coordinator/epoch/epoch_runner.hpp"

namespace lockstep::verification {

/// The start of an epoch.
struct EpochStart {
    OwnedSource source;
    PathPlace place;    // on the program
    MotorPositions at;  // of each axis, exactly
    TouchInputs touch;  // it ends at a touch of these
};

/// How far an axis came in an epoch: frames begun, and where it rests.
struct AxisEnd {
    FrameNumber ran = 0;
    Position at;
    bool ceased = false;  // its pulses ceased at the touch of the epoch
};

class EpochReplay {
public:
    /// `begin`: the recorded begin of frame 1. `devices`: as the events before the epoch have left them.
    EpochReplay(const MachineConfig& machine, Epoch epoch, EpochStart start, const Overrides& overrides, Tick begin,
                const ProgramDevices& devices);

    Epoch epoch() const { return runner_.epoch(); }
    /// The source after the frames made so far, for the next epoch of the leg.
    const OwnedSource& source() const { return runner_.source(); }

    /// Plans the frames after `behind` with other overrides. Returns false if some of them are made already.
    bool set_overrides(FrameNumber behind, const Overrides& overrides);

    /// Returns null if the epoch has no such frame or it was dropped.
    const Frame* frame(FrameNumber number);
    void forget_before(FrameNumber number);

    /// Returns the events with places in the frames up to `ran`, each event once.
    std::vector<EpochRunner::Happened> take_events(FrameNumber ran);

    /// Where the motors were at a tick, in an epoch with a touch of which frame `ran` was the last one run.
    MotorPositions positions_at(Tick tick, FrameNumber ran) const { return runner_.positions_at(tick - shift_, ran); }

    /// The inputs at whose touch the epoch ends.
    const TouchInputs& touch() const { return runner_.touch(); }
    Tick begin() const { return *runner_.made().start() + shift_; }
    /// The end of this frame.
    Tick end_of(FrameNumber frame) const { return begin() + runner_.made().ticks_of(frame); }

    EpochEnd evaluate(std::span<const AxisEnd> axes) const;

    /// The block of the program in motion at a tick.
    std::uint32_t block_at(Tick tick) const { return runner_.made().place_at(tick - shift_).block; }

private:
    void make_up_to(FrameNumber number);

    EpochRunner runner_;
    std::map<FrameNumber, Overrides> changes_;  // by the frame after which they hold
    Slot slot_ = 0;
    Ticks shift_;               // from the runner's own time to the recorded one
    std::deque<Frame> frames_;  // in recorded time
    FrameNumber made_ = 0;
    bool all_made_ = false;
};

}  // namespace lockstep::verification
