#include "core/axis/device_time.hpp"

#include <algorithm>
#include <utility>

#include "core/axis/device/retime.hpp"
#include "core/check.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {

DeviceTime::DeviceTime(MotorIndex motor, const MachineConfig& machine)
    : clocks_(machine), pace_(machine.frame_ticks(), limits_of(motors_of(machine)[motor], machine.tick_ns)) {}

Ticks DeviceTime::error() const {
    Ticks most = clocks_.error_at(clocks_.now());
    for (const Loaded& loaded : loaded_) {
        if (loaded.end > clocks_.device()) { most = std::max(most, loaded.error); }
    }
    return most;
}

DeviceStatus DeviceTime::in_machine_time(DeviceStatus status) const {
    status.now = clocks_.to_machine(status.now);
    return status;
}

DeviceOrder DeviceTime::in_device_time(DeviceOrder order) {
    if (clocks_.is_one_clock()) { return order; }
    if (const auto* begin = std::get_if<device::BeginRun>(&order)) {
        own_run_ = begin->own;
        machine_end_.reset();
        loaded_.clear();
    } else if (auto* frame = std::get_if<device::LoadFrame>(&order)) {
        load(*frame);
    } else if (auto* outputs = std::get_if<device::LoadOutputs>(&order)) {
        load(*outputs);
    }
    return order;
}

void DeviceTime::load(device::LoadFrame& frame) {
    const Tick machine_end = frame.start + total_ticks(frame.track.body);
    const Ticks tail = total_ticks(frame.track.tail);
    const bool joins = machine_end_ == frame.start;
    if (!joins) { pace_.begin(clocks_.to_device(frame.start), clocks_.device_rate()); }
    const Ticks start_error = joins ? end_error_ : Ticks{};
    end_error_ = clocks_.error_at(machine_end);
    Loaded loaded{.tail_error = clocks_.error_at(machine_end + tail)};
    frame.start = pace_.end();
    if (own_run_) {
        pace_.keep(total_ticks(frame.track.body));
        loaded.end = pace_.end() + tail;
    } else {
        pace(frame, machine_end, loaded);
    }
    loaded.body_end = pace_.end();
    loaded.error += std::max(start_error, end_error_);
    machine_end_ = machine_end;
    loaded.frame = frame;
    loaded_.push_back(loaded);
}

/// Outputs change where the frame loaded before them was fitted to the device's clock.
void DeviceTime::load(device::LoadOutputs& outputs) const {
    const Loaded& frame = loaded_.back();
    retime(outputs.track.body.begin(), outputs.track.body.size(), frame.body.machine, frame.body.when);
    retime(outputs.track.tail.begin(), outputs.track.tail.size(), frame.tail.machine, frame.tail.when);
}

template <typename Pieces>
FramePace::Part DeviceTime::part_of(const Pieces& pieces, Tick machine_end) const {
    return {total_ticks(pieces), pieces.size(), clocks_.to_device(machine_end), clocks_.device_rate()};
}

/// The error in the middle of a body is the error of its ends plus the bow caused by its changing rate.
void DeviceTime::pace(device::LoadFrame& frame, Tick machine_end, Loaded& loaded) {
    const FramePace::Part asked = part_of(frame.track.body, machine_end);
    const Retiming body = pace_.body(asked);
    loaded.body = {asked.lasts, body};
    end_error_ += length_of(asked.asked_end - body.end);
    loaded.error = body.bow();
    loaded.end = body.end;
    (void)retime(frame.track.body, body);
    if (frame.track.tail.empty()) { return; }
    const FramePace::Part rest = part_of(frame.track.tail, machine_end + total_ticks(frame.track.tail));
    const Retiming tail = pace_.tail(rest);
    loaded.tail = {rest.lasts, tail};
    loaded.tail_error += length_of(rest.asked_end - tail.end) + tail.bow();
    loaded.end = tail.end;
    (void)retime(frame.track.tail, tail);
}

ExecutedTrack DeviceTime::in_device_time(ExecutedTrack track) {
    track.commanded_start = track.start;
    track.clock_error = clocks_.machine_error();
    if (clocks_.is_one_clock()) { return track; }
    while (!loaded_.empty() && loaded_.front().frame.number < track.frame) { loaded_.pop_front(); }
    check(!loaded_.empty() && loaded_.front().frame.number == track.frame,
          "a frame is remembered as the device was given it until it is recorded");
    const Loaded& found = loaded_.front();
    if (track.epoch != 0) {
        for (const Piece& piece : track.pieces) { track.commanded_ticks.push_back(piece.ticks); }
    }
    const auto take = [&track](const auto& pieces) { track.pieces.assign(pieces.begin(), pieces.end()); };
    track.tail ? take(found.frame.track.tail) : take(found.frame.track.body);
    track.start = track.tail ? found.body_end : found.frame.start;
    track.clock_error = track.tail ? std::max(found.error, found.tail_error) : found.error;
    return track;
}

}  // namespace lockstep
