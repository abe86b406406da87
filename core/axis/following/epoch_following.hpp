// Follows the coordinator's frames: holds, arms or vetoes them by the rules of the protocol, loads them into the
// device, and records them when the device has run them.
#pragma once

#include <optional>
#include <span>

#include "core/axis/following/setpoint_follower.hpp"
#include "core/axis/state/axis_loop.hpp"
#include "core/axis/state/run_recorder.hpp"

namespace lockstep {

class EpochFollowing {
public:
    EpochFollowing(MotorIndex motor, const MachineConfig& machine) : motor_(motor), follower_(motor, machine) {}

    /// An epoch is in progress on this axis.
    bool is_open() const { return follower_.open(); }
    const SetpointFollower& follower() const { return follower_; }
    /// The highest frame of the epoch that the device has begun.
    FrameNumber ran() const { return ran_; }
    /// Counts since the start of the process.
    std::uint64_t refused_frames() const { return refused_frames_; }

    // Take messages. A state with a stamp later than any clock error explains is ignored.
    void take(const AxisState& peer, Slot now);
    void take(const MachineState& owner, Slot now);
    /// Takes a frame of the owner. `rest`: where the axis rests, if it may begin an epoch. Ignores a frame for which
    /// the device has no room yet. The owner sends it again.
    void take(const Frame& frame, std::optional<Position> rest, AxisLoop& loop);

    /// Takes the changes of the device's inputs since the last loop. The epoch in progress may end at one.
    void take(std::span<const InputEdge> edges, AxisLoop& loop);
    /// The first touch of an input of this device at which the newest epoch ends. An input with a longer debounce may
    /// report an earlier touch later.
    const std::optional<EpochTouch>& touch() const { return touch_; }
    /// The device has ended the newest epoch at a touch, before its frames ended.
    bool has_ceased() const { return has_ceased_; }

    /// Makes the checks that are due.
    void check(AxisLoop& loop);
    /// Call it if this axis cannot go on. Vetoes the lowest frame that a veto can still stop.
    void veto(AxisLoop& loop);
    /// Takes what the device has run since the last loop.
    void observe(AxisLoop& loop);
    void record(const DeviceStatus& device, AxisLoop& loop);
    /// Call it when the device has ended the run.
    void end(AxisLoop& loop);

private:
    bool has_room(const Frame& frame, const DeviceView& device) const;
    bool is_left_behind(const DeviceStatus& device) const;
    void begin(Epoch epoch, AxisLoop& loop);
    void refuse(const Frame& frame, FaultCode why, AxisLoop& loop);
    void end_at(Tick touch, std::uint8_t channel, AxisLoop& loop);

    MotorIndex motor_;
    SetpointFollower follower_;
    RunRecorder recorder_;
    std::optional<EpochTouch> touch_;
    bool has_ceased_ = false;
    Tick rested_;  // when the device was seen to have ended the newest epoch
    FrameNumber ran_ = 0;
    std::uint64_t refused_frames_ = 0;
    FaultCode last_refusal_ = FaultCode::None;
};

}  // namespace lockstep
