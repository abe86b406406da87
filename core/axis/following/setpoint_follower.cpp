#include "core/axis/following/setpoint_follower.hpp"

#include <limits>

#include "core/kinematics/motors.hpp"
#include "core/motion/frame_limits.hpp"

namespace lockstep {
namespace {

/// From rest a frame may start at the axis's whole step or at the exact fraction at which the axis came to rest.
Position start_from(Position asked, Position rest) {
    const bool whole = asked.count() == rest.count() && rests_on_whole_step(asked);
    return whole ? asked : rest;
}

}  // namespace

SetpointFollower::SetpointFollower(MotorIndex motor, const MachineConfig& machine)
    : motor_(motor),
      axes_(motor_count(machine)),
      timing_(machine.timing),
      slot_(machine.slot_ticks()),
      limits_(frame_limits_of(machine, motor)),
      outputs_(motor, machine),
      peers_(motor_count(machine)) {}

void SetpointFollower::receive(const AxisState& peer) {
    if (peer.axis >= axes_ || peer.axis == motor_) { return; }
    peers_[peer.axis].receive(peer.stamp, peer.epoch, peer.held);
    if (open_ && peer.epoch == epoch_) { add_veto(peer.veto); }
}

void SetpointFollower::receive(const MachineState& coordinator) {
    named_ = coordinator.epoch;
    coordinator_.receive(coordinator.stamp, coordinator.epoch,
                         coordinator.veto ? *coordinator.veto - 1 : std::numeric_limits<FrameNumber>::max());
    if (open_ && coordinator.epoch == epoch_) { add_veto(coordinator.veto); }
}

FaultCode SetpointFollower::offer(const Frame& frame, std::optional<Position> rest) {
    if (frame.axes.size() != axes_) { return FaultCode::ConfigMismatch; }
    const AxisTrack& track = frame.axes[motor_];
    const bool first = !open_ && rest && frame.epoch > epoch_ && frame.epoch == named_ && frame.number == 1;
    const bool has_room = frames_.size() < kMaxFramesKept;
    const bool next = open_ && frame.epoch == epoch_ && frame.number == held_ + 1 && !last_held_ && has_room;
    if (!first && !next) { return FaultCode::None; }
    const bool follows = first ? is_epoch_of(frame.epoch, frame.term) : frame.start == end_tick_;
    if (!follows) { return FaultCode::FrameDiscontinuous; }
    if (frame.start.value % slot_.value != 0 || frame.ticks.value <= 0) { return FaultCode::BadProgram; }
    MotionPoint end = first ? MotionPoint{start_from(track.from, *rest), 0, {}} : end_;
    const FaultCode fault = check_track(track, frame.ticks, frame.last, limits_, end);
    if (fault != FaultCode::None) { return fault; }
    const OutputTrack* const outputs = frame.outputs_of(motor_);
    if (outputs != nullptr) {
        const FaultCode why = outputs_.check(*outputs, frame.ticks, total_ticks(track.tail));
        if (why != FaultCode::None) { return why; }
    }
    if (first) {
        begin(frame.epoch);
        touch_ = frame.touch;
    }
    end_ = end;
    held_ = frame.number;
    last_held_ = frame.last;
    end_tick_ = frame.start + frame.ticks;
    frames_.push_back(
        {frame.number, frame.start, frame.ticks, frame.last, track, outputs != nullptr ? *outputs : OutputTrack{}});
    return FaultCode::None;
}

void SetpointFollower::begin(Epoch epoch) {
    open_ = true;
    epoch_ = epoch;
    held_ = checked_ = 0;
    veto_.reset();
    device_veto_.reset();
    last_held_ = false;
    frames_.clear();
}

std::optional<Slot> SetpointFollower::start_slot(FrameNumber k) const {
    if (k == held_ + 1 && !last_held_) { return rules::slot_of(end_tick_, slot_); }
    const HeldFrame* frame = find(k);
    return frame == nullptr ? std::nullopt : std::optional(rules::slot_of(frame->start, slot_));
}

/// Returns the other axes without evidence that they hold the frame.
MotorSet SetpointFollower::lacking(FrameNumber k, Slot start) const {
    MotorSet lacking;
    for (const MotorIndex m : motor_indices(axes_)) {
        if (m != motor_ && !peers_[m].holds(epoch_, k, start, timing_)) { lacking.insert(m); }
    }
    return lacking;
}

bool SetpointFollower::coordinator_holds(FrameNumber k, Slot start) const {
    return coordinator_.holds(epoch_, k, start, timing_);
}

void SetpointFollower::refuse(FrameNumber veto, const FailedCheck& check) {
    if (!veto_ || veto < *veto_) { failed_check_ = check; }
    add_veto(veto);
}

const std::vector<DeviceOrder>& SetpointFollower::decide(Slot now, bool publishes) {
    orders_.clear();
    std::optional<FrameNumber> unarmed;  // this axis never arms it, though others may run it
    for (FrameNumber k = checked_ + 1; open_ && k <= held_ + 1; ++k) {
        const std::optional<Slot> start = start_slot(k);
        if (!start) { break; }
        const rules::CheckTime time = rules::check_time(now, *start, timing_);
        const bool too_late = time == rules::CheckTime::TooLate;
        const FailedCheck check{too_late, held_ >= k, lacking(k, *start), !coordinator_holds(k, *start)};
        const bool all_hold = check.lacking.empty() && !check.no_coordinator;
        if (!too_late && rules::may_arm(k, {held_, veto_, all_hold})) {
            orders_.emplace_back(device::Arm{k});
        } else if (time == rules::CheckTime::Early || !publishes) {
            break;
        } else {
            refuse(too_late ? first_open(now) : k, check);
            if (too_late) { unarmed = rules::merge(unarmed, k); }
        }
        checked_ = k;
    }
    const auto veto = rules::merge(rules::merge(veto_, unarmed), device_veto_);
    if (veto != device_veto_) {
        device_veto_ = veto;
        orders_.emplace_back(device::Veto{*veto});
    }
    return orders_;
}

/// Returns the first frame that `may_veto` allows by its start. Frames that this axis lacks are taken to last
/// frame_slots, as all but the last one do.
template <typename MayVeto>
FrameNumber SetpointFollower::first_open(MayVeto&& may_veto) const {
    FrameNumber k = frames_.empty() ? held_ + 1 : frames_.front().number;
    for (; k <= held_; ++k) {
        if (may_veto(*start_slot(k))) { return k; }
    }
    Slot start = rules::slot_of(end_tick_, slot_);
    for (; !last_held_ && !may_veto(start); ++k) { start += timing_.frame_slots; }
    return k;
}

/// Returns the first frame for which a veto in the state published in slot `next` still reaches every axis in time.
FrameNumber SetpointFollower::first_open(Slot next) const {
    return first_open([next](Slot start) { return rules::axis_may_veto(next, start); });
}

void SetpointFollower::veto_for_own_reasons(Slot next) {
    if (open_) { add_veto(first_open(next)); }
}

void SetpointFollower::veto_for_touch(Slot next) {
    if (!open_) { return; }
    add_veto(first_open([&](Slot start) { return rules::veto_is_certain(next, start, timing_); }));
}

}  // namespace lockstep
