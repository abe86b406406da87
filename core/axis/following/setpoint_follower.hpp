// An axis's side of lease, arm, veto: the frames that it holds, the evidence that it has received, and its decisions.
#pragma once

#include <optional>
#include <vector>

#include "core/axis/device/device.hpp"
#include "core/axis/device/held_frames.hpp"
#include "core/axis/following/frame_check.hpp"
#include "core/axis/following/output_check.hpp"
#include "core/axis/state/axis_io.hpp"
#include "core/machine.hpp"
#include "core/protocol/frame_room.hpp"
#include "core/protocol/peer_evidence.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {

class SetpointFollower {
public:
    SetpointFollower(MotorIndex motor, const MachineConfig& machine);

    /// Takes evidence and a veto from another process. States of other epochs are evidence of nothing.
    void receive(const AxisState& peer);
    void receive(const MachineState& coordinator);

    /// Takes the next frame of the epoch in progress. Takes frame 1 of a newer epoch if `rest` says where the axis
    /// rests and the owner's newest state names that epoch. So a damaged frame cannot begin an epoch that no
    /// coordinator has begun. Ignores frames that are already held, of other epochs, or out of order, and returns None.
    /// The owner sends frames again as long as a process lacks them. Otherwise the frame is held (see held()), or the
    /// returned fault says why not.
    FaultCode offer(const Frame& frame, std::optional<Position> rest);

    /// Arms the frames that may be armed, and vetoes a frame that was not armed in time. It vetoes only in the loop
    /// that `publishes` this slot's state, because the veto reaches the others with that state. Returns the device's
    /// orders in order, valid until the next call.
    const std::vector<DeviceOrder>& decide(Slot now, bool publishes);

    /// Call it if this axis cannot continue. Vetoes the first frame for which the state published in slot `next` still
    /// reaches every axis in time.
    void veto_for_own_reasons(Slot next);
    /// Call it when an input of this axis's device has touched. Vetoes the first frame that no axis can have armed,
    /// because every axis needs the state published in slot `next`, or a later one, as evidence for it.
    void veto_for_touch(Slot next);
    /// The inputs at whose touch the newest epoch ends.
    const TouchInputs& touch() const { return touch_; }

    /// Call it when the device has ended the run of this epoch. Nothing more of the epoch is held or checked.
    void close() { open_ = false; }
    bool open() const { return open_; }
    /// Whether the epoch is complete when its frames up to `ran` have been run.
    bool is_complete(FrameNumber ran) const { return last_held_ && ran == held_; }

    Epoch epoch() const { return epoch_; }
    FrameNumber held() const { return held_; }
    std::optional<FrameNumber> veto() const { return veto_; }
    /// The check that last lowered the veto.
    const FailedCheck& failed_check() const { return failed_check_; }
    /// The held frames. The caller drops those that the device has run.
    HeldFrames& frames() { return frames_; }
    const HeldFrame* find(FrameNumber number) const { return frames_.find(number); }

private:
    void begin(Epoch epoch);
    MotorSet lacking(FrameNumber k, Slot start) const;
    bool coordinator_holds(FrameNumber k, Slot start) const;
    template <typename MayVeto>
    FrameNumber first_open(MayVeto&& may_veto) const;
    FrameNumber first_open(Slot next) const;
    void refuse(FrameNumber veto, const FailedCheck& check);
    std::optional<Slot> start_slot(FrameNumber k) const;
    void add_veto(std::optional<FrameNumber> veto) { veto_ = rules::merge(veto_, veto); }

    MotorIndex motor_;
    std::size_t axes_;
    ProtocolTiming timing_;
    Ticks slot_;
    AxisLimits limits_;
    OutputCheck outputs_;
    std::vector<PeerEvidence> peers_;
    PeerEvidence coordinator_;

    bool open_ = false;
    Epoch epoch_ = 0;
    Epoch named_ = 0;  // epoch that the owner's newest state names
    FrameNumber held_ = 0;
    FrameNumber checked_ = 0;  // every frame up to this one is decided
    TouchInputs touch_;
    std::optional<FrameNumber> veto_;
    FailedCheck failed_check_;
    std::optional<FrameNumber> device_veto_;  // the veto that was given to the device
    MotionPoint end_;                         // end of the last body held
    Tick end_tick_;
    bool last_held_ = false;
    HeldFrames frames_{kMaxFramesKept};
    std::vector<DeviceOrder> orders_;  // of one call
};

}  // namespace lockstep
