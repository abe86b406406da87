#include "core/axis/following/setpoint_follower.hpp"

#include "core/motion/frame_limits.hpp"

namespace lockstep {
namespace {

/// At rest an axis may set out from its whole step as well as from the very fraction it came to rest on.
Position start_from(Position asked, Position rest) {
    const bool whole = asked == rest_position(rest.count(), false) || asked == rest_position(rest.count(), true);
    return whole ? asked : rest;
}

}  // namespace

SetpointFollower::SetpointFollower(std::size_t axis, const MachineConfig& machine)
    : axis_(axis),
      axes_(machine.axes.size()),
      timing_(machine.timing),
      slot_(machine.slot_ticks()),
      limits_(frame_limits_of(machine, axis)),
      peers_(machine.axes.size()) {}

void SetpointFollower::hear(const AxisState& peer) {
    if (peer.axis >= axes_ || peer.axis == axis_) { return; }
    peers_[peer.axis].hear(peer);
    if (open_ && peer.epoch == epoch_) { add_veto(peer.veto); }
}

void SetpointFollower::hear(const MachineState& coordinator) {
    named_ = coordinator.epoch;
    if (open_ && coordinator.epoch == epoch_) { add_veto(coordinator.veto); }
}

FaultCode SetpointFollower::offer(const Frame& frame, std::optional<Position> rest) {
    if (frame.axes.size() != axes_) { return FaultCode::ConfigMismatch; }
    const AxisTrack& track = frame.axes[axis_];
    const bool first = !open_ && rest && frame.epoch > epoch_ && frame.epoch == named_ && frame.number == 1;
    const bool next = open_ && frame.epoch == epoch_ && frame.number == held_ + 1 && !last_held_;
    if ((!first && !next) || frames_.size() == kMaxFrames) { return FaultCode::None; }
    const bool follows = first ? is_epoch_of(frame.epoch, frame.term) : frame.start == end_tick_;
    if (!follows) { return FaultCode::FrameDiscontinuous; }
    if (frame.start.value % slot_.value != 0 || frame.ticks.value <= 0) { return FaultCode::BadProgram; }
    MotionPoint end = first ? MotionPoint{start_from(track.from, *rest), 0, {}} : end_;
    const FaultCode fault = check_track(track, frame.ticks, frame.last, limits_, end);
    if (fault != FaultCode::None) { return fault; }
    if (first) { begin(frame.epoch); }
    end_ = end;
    held_ = frame.number;
    last_held_ = frame.last;
    end_tick_ = frame.start + frame.ticks;
    frames_.push_back({frame.number, frame.start, frame.ticks, frame.last, track});
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

/// The other axes of which there is no evidence that they hold the frame.
AxisSet SetpointFollower::lacking(FrameNumber k, Slot start) const {
    AxisSet lacking = 0;
    for (std::size_t i = 0; i < axes_; ++i) {
        if (i != axis_ && !peers_[i].holds(epoch_, k, start, timing_)) { lacking |= axis_bit(i); }
    }
    return lacking;
}

void SetpointFollower::refuse(FrameNumber veto, const FailedCheck& check) {
    if (!veto_ || veto < *veto_) { failed_check_ = check; }
    add_veto(veto);
}

const std::vector<DeviceOrder>& SetpointFollower::decide(Slot now) {
    orders_.clear();
    std::optional<FrameNumber> unarmed;  // never to be armed, though others may run it
    for (FrameNumber k = checked_ + 1; open_; ++k) {
        const std::optional<Slot> start = start_slot(k);
        if (!start) { break; }
        const rules::CheckTime time = rules::check_time(now, *start, timing_);
        if (time == rules::CheckTime::Early) { break; }
        checked_ = k;
        const FailedCheck check{time == rules::CheckTime::TooLate, held_ >= k, lacking(k, *start)};
        if (check.too_late) {
            refuse(rules::veto_when_too_late(k), check);
            unarmed = rules::merge(unarmed, k);
        } else if (rules::may_arm(k, {held_, veto_, check.lacking == 0})) {
            orders_.emplace_back(device::Arm{k});
        } else {
            refuse(rules::veto_when_failed(k), check);
        }
        if (k > held_) { break; }
    }
    const auto veto = rules::merge(rules::merge(veto_, unarmed), device_veto_);
    if (veto != device_veto_) {
        device_veto_ = veto;
        orders_.emplace_back(device::Veto{*veto});
    }
    return orders_;
}

void SetpointFollower::veto_for_own_reasons(Slot now) {
    if (!open_) { return; }
    FrameNumber k = frames_.empty() ? held_ + 1 : frames_.front().number;
    for (; k <= held_ + 1; ++k) {
        const std::optional<Slot> start = start_slot(k);
        if (start && rules::axis_may_veto(now, *start)) { break; }
    }
    add_veto(k);
}

}  // namespace lockstep
