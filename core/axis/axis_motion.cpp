// What the device has done since the last look.
#include <algorithm>
#include <cmath>

#include "core/axis/axis_controller.hpp"
#include "core/check.hpp"

namespace lockstep {

void AxisController::observe(const DeviceStatus& device, AxisOutputs& out) {
    device_ = device;
    ring_room_ = device.free_segments;
    if (mode_ == Mode::Rest) { run_ = std::max({run_, device.run, device.run_asked}); }  // for another process, perhaps
    if (mode_ != Mode::Rest && device.run == run_) {
        veto_when_left_behind(device, out);
        record_progress(device, out);
        follow_speed(device);
        if (device.finished) { end_run(device, out); }
    }
    if (phase_ == AxisPhase::Stop && mode_ == Mode::Rest) { happen(AxisEvent::Released); }
    if (std::abs(following_error()) > kMaxFollowingError && homed_ && fault_ == FaultCode::None) {
        homed_ = false;
        fail(FaultCode::FollowingError, out);
    }
}

/// It makes no pulses, as far as is known, from where it was last seen: its run is at an end there. Where the slide is,
/// only the device can prove, if it comes back.
void AxisController::lose_device(AxisOutputs& out) {
    has_device_ = false;
    if (mode_ == Mode::Following) { veto_for_own_reasons(out); }
    if (mode_ != Mode::Rest && device_.run == run_) {
        DeviceStatus end = device_;
        end.finished = end.stopped_by_host = true;
        record_progress(end, out);
    }
    if (mode_ == Mode::Following) { end_following(out); }
    abandon_local();
    device_.moving = false;
    device_.velocity = {};
    last_speed_ = 0;
    homed_ = false;
    unproved_ = FaultCode::DeviceMissing;
    fail(FaultCode::DeviceLost, out);
}

/// The device has fallen to a tail, perhaps while this process stalled with a frame decided on: others may be running
/// it. What this axis holds from here on must be no evidence to them.
void AxisController::veto_when_left_behind(const DeviceStatus& device, AxisOutputs& out) {
    const bool fell = device.in_tail || (device.finished && !follower_.is_complete(device.frame));
    if (mode_ == Mode::Following && fell) { veto_for_own_reasons(out); }
}

/// Records each body when the next has begun, and the last with its tail when the run has ended.
void AxisController::record_progress(const DeviceStatus& device, AxisOutputs& out) {
    const bool local = mode_ == Mode::Local;
    if (!local) { ran_ = device.frame; }
    for (; recorded_ < device.frame; ++recorded_) {
        const FrameNumber k = recorded_ + 1;
        const HeldFrame& frame = check_found(local ? local_->find(k) : follower_.find(k),
                                             "a frame that the device runs is held until it is recorded");
        if (k < device.frame) {
            record(frame, false, {}, out);
        } else if (device.finished) {
            record_end(frame, device, out);
        } else {
            break;
        }
    }
    if (!local) { return follower_.forget_before(recorded_ + 1); }
    while (!local_->held.empty() && local_->held.front().number <= recorded_) { local_->held.pop_front(); }
}

void AxisController::record_end(const HeldFrame& frame, const DeviceStatus& device, AxisOutputs& out) {
    const bool stopped = device.stopped_by_limit || device.stopped_by_trigger || device.stopped_by_host;
    const std::int64_t here = device.position.count() - zero_count_;
    const bool in_tail = !frame.last && (!stopped || device.in_tail);
    record(frame, false, stopped && !in_tail ? std::optional(here) : std::nullopt, out);
    if (in_tail && !frame.track.tail.empty()) {
        record(frame, true, stopped ? std::optional(here) : std::nullopt, out);
    }
}

void AxisController::record(const HeldFrame& frame, bool tail, std::optional<std::int64_t> cut_at, AxisOutputs& out) {
    ExecutedTrack r{.epoch = mode_ == Mode::Local ? 0 : follower_.epoch(), .frame = frame.number, .tail = tail};
    r.start = tail ? frame.end() : frame.start;
    r.from = tail ? frame.body_end() : frame.track.from;
    const auto take = [&r](const auto& pieces) { r.pieces.assign(pieces.begin(), pieces.end()); };
    tail ? take(frame.track.tail) : take(frame.track.body);
    Position end = r.from;
    for (const Piece& piece : r.pieces) { end = end + piece.covered(); }
    r.cut = cut_at.has_value();
    r.stop_count = cut_at.value_or(end.count());
    r.zero_count = zero_count_;
    out.tracks.push_back(std::move(r));
}

/// The three moving states follow the speed of the pulses themselves. Out of rest it rises, however slow it is; an axis
/// that others move without stands by.
void AxisController::follow_speed(const DeviceStatus& device) {
    constexpr double kSteady = 0x1p-40;  // steps per tick: what rounding makes of a constant speed, 0 too
    const double speed = std::abs(device.velocity.steps_per_tick());
    const double change = speed - last_speed_;
    const bool rested = last_speed_ <= kSteady;
    last_speed_ = speed;
    if (phase_ == AxisPhase::Initialize || device.finished) { return; }
    if (speed <= kSteady) {
        if (mode_ == Mode::Following) { happen(AxisEvent::MotionEnds); }
    } else if (!rested && std::abs(change) <= kSteady) {
        happen(AxisEvent::SpeedSteady);
    } else {
        happen(change > 0 ? AxisEvent::SpeedRises : AxisEvent::SpeedFalls);
    }
}

void AxisController::end_run(const DeviceStatus& device, AxisOutputs& out) {
    last_speed_ = 0;
    const bool was_local = mode_ == Mode::Local;
    if (!was_local && !device.stopped_by_limit && !device.stopped_by_host) { happen(AxisEvent::MotionEnds); }
    if (device.stopped_by_host) {
        homed_ = false;
        abandon_local();
        happen(AxisEvent::HostStops);
        fail(FaultCode::EmergencyStopped, out);
    } else if (device.capture_overflow || (device.bad_segment && !(was_local && device.frame == 0))) {
        abandon_local();
        fail(FaultCode::DeviceFault, out);
    } else if (was_local) {
        end_local(device, out);
    } else if (device.stopped_by_limit) {
        homed_ = false;
        veto_for_own_reasons(out);
        happen(AxisEvent::LimitStops);
        fail(FaultCode::LimitHit, out);
    }
    if (!was_local) { end_following(out); }
}

void AxisController::end_following(AxisOutputs& out) {
    mode_ = Mode::Rest;
    follower_.close();
    out.notices.push_back({AxisNotice::Kind::EpochEnded, FaultCode::None, follower_.epoch()});
}

}  // namespace lockstep
