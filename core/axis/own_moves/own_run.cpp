#include "core/axis/own_moves/own_run.hpp"

#include <utility>

#include "core/protocol/frame_room.hpp"

namespace lockstep {

/// Loads the first frame at once, even if it starts late, because without a frame the device cannot begin or end its
/// run.
void OwnRun::feed(AxisLoop& loop) {
    const Tick ahead = loop.now + ahead_;
    const auto wants_more = [&] { return frames_.none_made() || (!frames_.all_made() && frames_.end() < ahead); };
    while (!is_halted_ && (waiting_ || wants_more())) {
        if (!waiting_) { waiting_ = frames_.next(); }
        if (!may_load(*waiting_)) { return; }
        if (!loop.device.reserve(ring_entries(waiting_->track))) { return; }
        held_.push_back(*std::exchange(waiting_, std::nullopt));
        loop.load(held_.back());
        loop.out.orders.emplace_back(device::Arm{held_.back().number});
    }
}

/// The device itself ends a jog that is not renewed, because it gets no frames for the time after.
bool OwnRun::may_load(const HeldFrame& frame) const { return !until_ || frame.number == 1 || frame.end() <= *until_; }

void OwnRun::halt(AxisLoop& loop) {
    is_halted_ = true;
    const FrameNumber begun = loop.device.is_in_newest_run() ? loop.device.status().frame : 0;
    loop.out.orders.emplace_back(device::Veto{begun + 1});
}

void OwnRun::record(const DeviceStatus& device, AxisLoop& loop) {
    recorder_.take(device, {.zero_count = loop.condition.position.zero_count()}, held_, loop.out.tracks);
}

/// If the start was missed, nothing has moved. If the frames ran out, the axis rests on a whole step.
std::optional<LocalMove> OwnRun::rest(const DeviceStatus& device) const {
    LocalMove rest = move_;
    rest.steps = target_ - device.position.count();
    const bool stopped = device.stopped_by_trigger || device.stopped_by_limit;
    if (stopped || is_halted_ || rest.steps == 0) { return std::nullopt; }
    if (device.frame > 0) { rest.ticks.reset(); }
    return rest;
}

}  // namespace lockstep
