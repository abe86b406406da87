#include "core/axis/device_time.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/axis/device/retime.hpp"
#include "core/check.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {
DeviceTime::DeviceTime(std::size_t axis, const MachineConfig& machine)
    : tick_ns_(machine.tick_ns),
      machine_(machine.tick_ns, machine.timing.time_source,
               machine.timing.time_source == TimeSource::Ptp ? machine.clock_error_limit() : Ticks{}),
      shown_(machine.tick_ns),
      pace_(machine.frame_ticks(), limits_of(motors_of(machine)[axis], machine.tick_ns)) {}

bool DeviceTime::look(Tick own, const std::optional<Device>& device, bool in_use) {
    if (device) { clock_ = device->clock; }
    if (device && device->reading && !certain(*device->reading)) { return false; }
    own_ = own;
    if (!machine_.known() || (clock_ == DeviceClock::Own && !shown_.known())) { return false; }
    now_ = machine_.advance(own, in_use);
    return true;
}

/// Takes a reading of the device. Returns false if it leaves a doubt.
bool DeviceTime::certain(const ClockExchange& reading) {
    const bool stands_still = std::exchange(device_, reading.received) == reading.received;
    if (clock_ == DeviceClock::Host) { return true; }
    if (stands_still && shown_.known()) {
        stood_still_ = true;
        return true;
    }
    if (std::exchange(changed_, false)) { shown_ = ClockEstimator(tick_ns_); }
    const bool is_first = !shown_.known();
    const Ticks within{(reading.arrived - reading.sent).value / 2};
    const Tick own = reading.sent + within;
    const auto finding = shown_.offer(reading);
    if (finding == ClockEstimator::Finding::Doubtful) { return false; }
    const bool was_set = finding == ClockEstimator::Finding::ClockSet;
    if (was_set) { own_was_set(own, reading.received, within); }
    stood_still_ = false;
    const double aged = std::abs(static_cast<double>((reading.received - agreed_.shown).value)) * shown_.rate_error();
    const bool tells_more = static_cast<double>((within - agreed_.within).value) <= aged;
    if (is_first || was_set || tells_more) { agreed_ = {own, within, reading.received}; }
    return true;
}

/// This process's clock was set by the time that it counted since the agreed reading beyond what the device's clock
/// counted. If the device's clock stood still meanwhile, this says nothing about machine time, and the exchanges with
/// the coordinator have to correct it.
void DeviceTime::own_was_set(Tick own, Tick shown, Ticks within) {
    const auto by_device = static_cast<double>((shown - agreed_.shown).value);
    const Ticks passed{std::llround(by_device / (1 + shown_.rate()))};
    const Ticks rounding{2 + std::llround(std::ceil(std::abs(by_device) * shown_.rate_error()))};
    const Ticks error = rounding + within + agreed_.within;
    const Ticks by = own - agreed_.own - passed;
    if (!stood_still_) { machine_.own_was_set(by, error); }
    shown_.own_was_set(by, error);
}

Ticks DeviceTime::error_at(Tick machine) const {
    const Tick own = machine_.own_at(machine);
    return machine_.error(own) + shown_at(own).error;
}

Ticks DeviceTime::error() const {
    Ticks most = error_at(now_);
    for (const Loaded& loaded : loaded_) {
        if (loaded.end > device_) { most = std::max(most, loaded.error); }
    }
    return most;
}

/// Converts relative to the last look, by the rate of the clocks.
Tick DeviceTime::to_machine(Tick device) const {
    const ClockView shown = shown_at(own_);
    const auto since = static_cast<double>((device - shown.other).value);
    return machine_.at(own_ + Ticks{std::llround(since / (1 + shown.rate))});
}

ClockView DeviceTime::device_clock() const {
    if (is_one_clock()) { return {.own = device_, .other = device_, .error = machine_.error(device_)}; }
    const ClockView shown = shown_at(own_);
    const ClockView machine = machine_.estimate(own_);
    return {.own = shown.other,
            .other = machine.other,
            .rate = (1 + machine.rate) / (1 + shown.rate) - 1,
            .error = shown.error + machine.error,
            .rate_error = shown.rate_error + machine.rate_error};
}

DeviceStatus DeviceTime::in_machine_time(DeviceStatus status) const {
    status.now = to_machine(status.now);
    return status;
}

DeviceOrder DeviceTime::in_device_time(DeviceOrder order) {
    if (is_one_clock()) { return order; }
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
    if (!joins) { pace_.begin(to_device(frame.start), clocks()); }
    const Ticks start_error = joins ? end_error_ : Ticks{};
    end_error_ = error_at(machine_end);
    Loaded loaded{.tail_error = error_at(machine_end + tail)};
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
    return {total_ticks(pieces), pieces.size(), to_device(machine_end), clocks()};
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
    track.clock_error = machine_.error(own_);
    if (is_one_clock()) { return track; }
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
