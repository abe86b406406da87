#include "core/coordinator/epoch/frames_in_flight.hpp"

#include <algorithm>

namespace lockstep {

void FramesInFlight::clear() {
    frames_.clear();
    veto_.reset();
    received_veto_.reset();
}

FrameNumber FramesInFlight::receive(Epoch epoch, FrameNumber newest, std::span<const AxisView> axes) {
    FrameNumber held_by_all = newest;
    for (const AxisView& axis : axes) {
        const bool follows = axis.state && axis.state->epoch == epoch;
        held_by_all = std::min(held_by_all, follows ? axis.state->held : 0);
        if (follows) { received_veto_ = rules::merge(received_veto_, axis.state->veto); }
    }
    return held_by_all;
}

void FramesInFlight::repeat(Slot now, FrameNumber held, ReusedVector<Frame>& frames) {
    while (!frames_.empty() && now >= rules::slot_of(frames_.front().start, slot_)) { frames_.pop_front(); }
    for (std::size_t k = 0; k < frames_.size(); ++k) {
        const Frame& frame = frames_[k];
        const bool in_time = rules::may_send(now, rules::slot_of(frame.start, slot_), timing_);
        const bool may_run = !veto() || *veto() > frame.number;
        if (in_time && may_run && frame.number > held) { frames.push_back(frame); }
    }
}

void FramesInFlight::stop(Slot next, FrameNumber newest) {
    if (veto_) { return; }
    veto_ = newest + 1;
    for (std::size_t k = 0; k < frames_.size() && *veto_ > newest; ++k) {
        const Slot start = rules::slot_of(frames_[k].start, slot_);
        if (rules::veto_is_certain(next, start, timing_)) { veto_ = frames_[k].number; }
    }
}

}  // namespace lockstep
