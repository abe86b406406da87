// An axis's side of lease, arm, veto: which frames it holds, what it has received, what it decides.
#pragma once

#include <optional>
#include <vector>

#include "core/axis/device/device.hpp"
#include "core/axis/device/held_frames.hpp"
#include "core/axis/following/frame_check.hpp"
#include "core/axis/state/axis_io.hpp"
#include "core/machine.hpp"
#include "core/protocol/frame_room.hpp"
#include "core/protocol/peer_evidence.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {

class SetpointFollower {
public:
    /// `axis` of `axes`, by their places in the configuration.
    SetpointFollower(std::size_t axis, const MachineConfig& machine);

    /// Evidence and vetoes from the others. States of other epochs are evidence of nothing.
    void receive(const AxisState& peer);
    void receive(const MachineState& coordinator);

    /// Takes a frame of the epoch in progress, or frame 1 of a newer one, which the owner's newest state must name too,
    /// when `rest` says where the axis rests: a frame damaged on its way cannot begin an epoch that no coordinator has
    /// begun. Frames held already, of other epochs, or out of order are left alone: None, and nothing changes. They
    /// come again as long as a process lacks them. Otherwise the frame is held (held() says so), or the fault says why
    /// not.
    FaultCode offer(const Frame& frame, std::optional<Position> rest);

    /// Arms what it may, and vetoes what it has not armed in time, in the loop that `publishes` this slot's state: a
    /// veto reaches the others in time only from then on. Returns the device's orders in order; valid until the next
    /// call.
    const std::vector<DeviceOrder>& decide(Slot now, bool publishes);

    /// Vetoes the first frame of which every axis still learns in time by the state published in slot `next`: this axis
    /// cannot go on.
    void veto_for_own_reasons(Slot next);

    /// The device has ended the run of this epoch: nothing more of it is held or checked.
    void close() { open_ = false; }
    bool open() const { return open_; }
    /// Whether an epoch is at its very end when its frames up to `ran` have been run.
    bool is_complete(FrameNumber ran) const { return last_held_ && ran == held_; }

    Epoch epoch() const { return epoch_; }
    FrameNumber held() const { return held_; }
    std::optional<FrameNumber> veto() const { return veto_; }
    /// The check that has lowered the veto last.
    const FailedCheck& failed_check() const { return failed_check_; }
    /// Those held. Frames that the device has run are to be forgotten.
    HeldFrames& frames() { return frames_; }
    const HeldFrame* find(FrameNumber number) const { return frames_.find(number); }

private:
    void begin(Epoch epoch);
    AxisSet lacking(FrameNumber k, Slot start) const;
    bool coordinator_holds(FrameNumber k, Slot start) const;
    FrameNumber first_open(Slot next) const;
    void refuse(FrameNumber veto, const FailedCheck& check);
    std::optional<Slot> start_slot(FrameNumber k) const;
    void add_veto(std::optional<FrameNumber> veto) { veto_ = rules::merge(veto_, veto); }

    std::size_t axis_;
    std::size_t axes_;
    ProtocolTiming timing_;
    Ticks slot_;
    AxisLimits limits_;
    std::vector<PeerEvidence> peers_;
    PeerEvidence coordinator_;

    bool open_ = false;
    Epoch epoch_ = 0;
    Epoch named_ = 0;  // by the owner
    FrameNumber held_ = 0;
    FrameNumber checked_ = 0;  // every frame up to this one is decided
    std::optional<FrameNumber> veto_;
    FailedCheck failed_check_;
    std::optional<FrameNumber> device_veto_;  // ordered of the device
    MotionPoint end_;                         // of the last body held
    Tick end_tick_;
    bool last_held_ = false;
    HeldFrames frames_{kMaxFramesKept};
    std::vector<DeviceOrder> orders_;  // of one call
};

}  // namespace lockstep
