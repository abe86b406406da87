#include "core/axis/device_time.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/axis/retime.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kRemembered = 64;  // frames: more than can be loaded and not yet recorded

}  // namespace

DeviceTime::DeviceTime(const MachineConfig& machine)
    : tick_ns_(machine.tick_ns),
      source_(machine.timing.time_source),
      ptp_error_(source_ == TimeSource::Ptp ? machine.clock_error_limit() : Ticks{}),
      machine_(machine.tick_ns),
      shown_(machine.tick_ns) {}

bool DeviceTime::look(Tick own, const Device& device, bool in_use) {
    device_ = device.now;
    if (source_ != TimeSource::Network) {
        now_ = own;
        return true;
    }
    if (!certain(own, device.shares_clock ? own : device.now) || !machine_.known()) { return false; }
    now_ = machine_.advance(own, in_use);
    return true;
}

/// Takes a look at the device's clock.
bool DeviceTime::certain(Tick own, Tick shown) {
    if (std::exchange(changed_, false)) { shown_ = ClockEstimator(tick_ns_); }
    const auto finding = shown_.offer({own, shown, shown, own});
    if (finding == ClockEstimator::Finding::Doubtful) { return false; }
    if (finding == ClockEstimator::Finding::ClockSet) { own_was_set(own, shown); }
    own_ = own;
    seen_ = shown;
    return true;
}

/// What this process's clock says of the time since the last look, beyond what the device's says.
void DeviceTime::own_was_set(Tick own, Tick shown) {
    const auto by_device = static_cast<double>((shown - seen_).value);
    const Ticks passed{std::llround(by_device / (1 + shown_.rate()))};
    const Ticks error{2 + std::llround(std::ceil(std::abs(by_device) * shown_.rate_error()))};
    const Ticks by = own - own_ - passed;
    machine_.own_was_set(by, error);
    shown_.own_was_set(by, error);
}

Ticks DeviceTime::error_at(Tick machine) const {
    const Tick own = machine_.own_at(machine);
    return machine_.error(own) + shown_.at(own).error;
}

Ticks DeviceTime::error() const {
    if (source_ != TimeSource::Network) { return ptp_error_; }
    Ticks most = error_at(now_);
    for (const Loaded& loaded : loaded_) {
        if (loaded.end > device_) { most = std::max(most, loaded.error); }
    }
    return most;
}

/// Relative to the last look: the two clocks' rates differ by parts in ten thousand, a status is a loop old at most.
Tick DeviceTime::to_machine(Tick device) const {
    if (source_ != TimeSource::Network) { return device; }
    return machine_.at(own_ + (device - shown_.at(own_).other));
}

ClockView DeviceTime::device_clock() const {
    if (source_ != TimeSource::Network) { return {.own = device_, .other = device_, .error = ptp_error_}; }
    const ClockView shown = shown_.view(own_);
    const ClockView machine = machine_.estimate().view(own_);
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
    if (source_ != TimeSource::Network) { return order; }
    if (const auto* begin = std::get_if<device::BeginRun>(&order)) {
        own_run_ = begin->own;
        machine_end_.reset();
        loaded_.clear();
    } else if (auto* frame = std::get_if<device::LoadFrame>(&order)) {
        load(*frame);
    }
    return order;
}

void DeviceTime::load(device::LoadFrame& frame) {
    const Tick machine_end = frame.start + total_ticks(frame.track.body);
    const bool joins = machine_end_ == frame.start;
    const Ticks start_error = joins ? end_error_ : Ticks{};
    const Tick start = joins ? device_end_ : to_device(frame.start);
    end_error_ = error_at(machine_end);
    Loaded loaded{.tail_error = error_at(machine_end + total_ticks(frame.track.tail))};
    if (own_run_) {
        frame.start = start;
        loaded.body_end = start + total_ticks(frame.track.body);
        loaded.end = loaded.body_end + total_ticks(frame.track.tail);
    } else {
        loaded.body_end = start;
        stretch(frame, machine_end, loaded);
    }
    loaded.error = std::max(start_error, end_error_);
    machine_end_ = machine_end;
    device_end_ = loaded.body_end;
    loaded.frame = frame;
    loaded_.push_back(loaded);
    if (loaded_.size() > kRemembered) { loaded_.pop_front(); }
}

/// So many ticks of the device's clock for so many of the machine's: what is asked, or as near as the slew allows; a
/// tick for each piece.
Ticks DeviceTime::slewed(Ticks machine, Ticks asked, std::size_t pieces) const {
    const double as_clocks_go = static_cast<double>(machine.value) / (1 + device_clock().rate);
    const double most = static_cast<double>(machine.value) * MachineTime::kMaxSlew;
    const double least = std::floor(as_clocks_go - most);
    const double longest = std::ceil(as_clocks_go + most);
    const double ticks = std::clamp(static_cast<double>(asked.value), least, longest);
    return {std::max(std::llround(ticks), static_cast<long long>(pieces))};
}

/// `loaded.body_end` is where the frame is to start, and becomes what it says.
void DeviceTime::stretch(device::LoadFrame& frame, Tick machine_end, Loaded& loaded) {
    const Tick start = loaded.body_end;
    const Tick asked_end = to_device(machine_end);
    loaded.body_end = start + slewed(total_ticks(frame.track.body), asked_end - start, frame.track.body.size());
    end_error_ += length_of(asked_end - loaded.body_end);
    loaded.end = loaded.body_end;
    if (!frame.track.tail.empty()) {
        const Ticks tail = total_ticks(frame.track.tail);
        const Tick asked_rest = to_device(machine_end + tail);
        loaded.end += slewed(tail, asked_rest - loaded.body_end, frame.track.tail.size());
        loaded.tail_error += length_of(asked_rest - loaded.end);
    }
    (void)retime(frame.track.body, {start, loaded.body_end});
    (void)retime(frame.track.tail, {loaded.body_end, loaded.end});
    frame.start = start;
}

ExecutedTrack DeviceTime::in_device_time(ExecutedTrack track) const {
    track.commanded_start = track.start;
    track.clock_error = ptp_error_;
    const auto found = std::ranges::find(loaded_, track.frame, [](const Loaded& l) { return l.frame.number; });
    if (source_ != TimeSource::Network || found == loaded_.end()) { return track; }
    if (track.epoch != 0) {
        for (const Piece& piece : track.pieces) { track.commanded_ticks.push_back(piece.ticks); }
    }
    const auto take = [&track](const auto& pieces) { track.pieces.assign(pieces.begin(), pieces.end()); };
    track.tail ? take(found->frame.track.tail) : take(found->frame.track.body);
    track.start = track.tail ? found->body_end : found->frame.start;
    track.clock_error = track.tail ? std::max(found->error, found->tail_error) : found->error;
    return track;
}

}  // namespace lockstep
