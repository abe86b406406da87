#include "core/axis/following/epoch_following.hpp"

#include <algorithm>
#include <utility>

#include "core/check.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {
namespace {

/// With room for the pieces that fitting it to the device's clock adds.
std::size_t room_for(const AxisTrack& track) { return ring_entries(track) + kDevicePieces; }

/// The first of these inputs that the axis's device has and that touches. `closed`: the device's closed inputs.
std::optional<std::uint8_t> touching(const TouchInputs& touch, MotorIndex motor, std::uint32_t closed) {
    for (const TouchInput& input : touch.any_of) {
        if (input.motor == motor && touch.is_touched(input, closed)) { return input.channel; }
    }
    return std::nullopt;
}

/// Whether the change of an input of the axis's device is a touch of one of these.
bool is_touch(const TouchInputs& touch, MotorIndex motor, const InputEdge& edge) {
    const bool is_awaited = std::ranges::any_of(
        touch.any_of, [&](const TouchInput& input) { return input.motor == motor && input.channel == edge.channel; });
    return is_awaited && edge.closed != touch.opens;
}

}  // namespace

void EpochFollowing::take(const AxisState& peer, Slot now) {
    if (peer.stamp <= now + rules::kHopSlots) { follower_.receive(peer); }
}

void EpochFollowing::take(const MachineState& owner, Slot now) {
    if (owner.stamp <= now + rules::kHopSlots) { follower_.receive(owner); }
}

void EpochFollowing::take(const Frame& frame, std::optional<Position> rest, AxisLoop& loop) {
    if (!has_room(frame, loop.device)) { return; }
    const bool was_open = is_open();
    const FrameNumber held = was_open ? follower_.held() : 0;
    const FaultCode fault = follower_.offer(frame, rest);
    if (!was_open && is_open()) { begin(frame.epoch, loop); }
    if (fault != FaultCode::None) { return refuse(frame, fault, loop); }
    if (!is_open() || follower_.held() == held) { return; }
    last_refusal_ = FaultCode::None;
    if (held == 0) { loop.begin_run(follower_.touch().ceasing(motor_), follower_.touch().opens); }
    lockstep::check(loop.device.reserve(room_for(frame.axes[motor_])), "there is room for the frame");
    loop.load(check_found(follower_.find(follower_.held()), "the follower keeps the newest frame it holds"));
}

bool EpochFollowing::has_room(const Frame& frame, const DeviceView& device) const {
    return motor_ >= frame.axes.size() || room_for(frame.axes[motor_]) <= device.free_segments();
}

/// If the input touches already, the epoch ends before it moves.
void EpochFollowing::begin(Epoch epoch, AxisLoop& loop) {
    recorder_.begin();
    ran_ = 0;
    touch_.reset();
    has_ceased_ = false;
    loop.notice({AxisNotice::Kind::EpochBegun, FaultCode::None, epoch});
    const DeviceStatus& device = loop.device.status();
    if (const auto channel = touching(follower_.touch(), motor_, device.inputs)) { end_at(device.now, *channel, loop); }
}

/// An input follows its pin with a delay, so a touch may become known when the axis rests already. The touch at which
/// the pulses ceased is one of the epoch, even if its estimated tick is a little behind that of the rest.
void EpochFollowing::take(std::span<const InputEdge> edges, AxisLoop& loop) {
    for (const InputEdge& edge : edges) {
        const bool is_due = has_ceased_ && !touch_;
        if (!is_open() && edge.tick > rested_ && !is_due) { return; }
        if (is_touch(follower_.touch(), motor_, edge)) { end_at(edge.tick, edge.channel, loop); }
    }
}

/// Later touches are part of the first one.
void EpochFollowing::end_at(Tick touch, std::uint8_t channel, AxisLoop& loop) {
    if (touch_ && touch_->tick <= touch) { return; }
    touch_ = EpochTouch{follower_.epoch(), touch, channel};
    loop.notice({AxisNotice::Kind::Touched, FaultCode::None, static_cast<std::uint64_t>(touch.value)});
    follower_.veto_for_touch(loop.next_state);
}

/// Frames are repeated, so the same refusal is reported only once.
void EpochFollowing::refuse(const Frame& frame, FaultCode why, AxisLoop& loop) {
    ++refused_frames_;
    if (std::exchange(last_refusal_, why) != why) { loop.notice({AxisNotice::Kind::FrameRefused, why, frame.number}); }
}

void EpochFollowing::check(AxisLoop& loop) {
    if (!is_open()) { return; }
    const auto veto_before = follower_.veto();
    for (const DeviceOrder& order : follower_.decide(loop.slot, loop.publishes())) { loop.out.orders.push_back(order); }
    if (follower_.veto() == veto_before) { return; }
    loop.notice({AxisNotice::Kind::Vetoed, FaultCode::None, *follower_.veto(), follower_.failed_check()});
}

void EpochFollowing::veto(AxisLoop& loop) {
    const auto veto_before = follower_.veto();
    follower_.veto_for_own_reasons(loop.next_state);
    if (follower_.veto() == veto_before) { return; }
    loop.notice({AxisNotice::Kind::Vetoed, FaultCode::None, *follower_.veto()});
}

void EpochFollowing::observe(AxisLoop& loop) {
    const DeviceStatus& device = loop.device.status();
    has_ceased_ = device.finished && device.stopped_by_trigger;
    if (has_ceased_) { follower_.veto_for_touch(loop.next_state); }
    if (is_left_behind(device)) { veto(loop); }
    record(device, loop);
}

/// The device has begun a tail, perhaps while this process stalled after it had decided on a frame. Others may be
/// running that frame. From here on the state of this axis must be no evidence for them. If its pulses ceased at a
/// touch, those of all other motors that move did so too.
bool EpochFollowing::is_left_behind(const DeviceStatus& device) const {
    const bool has_ended = device.finished && !has_ceased_;
    return device.in_tail || (has_ended && !follower_.is_complete(device.frame));
}

void EpochFollowing::record(const DeviceStatus& device, AxisLoop& loop) {
    ran_ = device.frame;
    recorder_.take(device, {follower_.epoch(), loop.condition.position.zero_count()}, follower_.frames(),
                   loop.out.tracks);
}

void EpochFollowing::end(AxisLoop& loop) {
    follower_.close();
    rested_ = loop.device.status().now;
    loop.notice({AxisNotice::Kind::EpochEnded, FaultCode::None, follower_.epoch()});
}

}  // namespace lockstep
