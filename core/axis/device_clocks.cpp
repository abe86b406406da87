#include "core/axis/device_clocks.hpp"

#include <cmath>
#include <utility>

namespace lockstep {

DeviceClocks::DeviceClocks(const MachineConfig& machine)
    : tick_ns_(machine.tick_ns),
      machine_(machine.tick_ns, machine.timing.time_source,
               machine.timing.time_source == TimeSource::Ptp ? machine.clock_error_limit() : Ticks{}),
      shown_(machine.tick_ns) {}

bool DeviceClocks::look(Tick own, const std::optional<Device>& device, bool in_use) {
    if (device) { clock_ = device->clock; }
    if (device && device->reading && !certain(*device->reading)) { return false; }
    own_ = own;
    if (!machine_.known() || (clock_ == DeviceClock::Own && !shown_.known())) { return false; }
    now_ = machine_.advance(own, in_use);
    return true;
}

/// Takes a reading of the device. Returns false if it leaves a doubt.
bool DeviceClocks::certain(const ClockExchange& reading) {
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
void DeviceClocks::own_was_set(Tick own, Tick shown, Ticks within) {
    const auto by_device = static_cast<double>((shown - agreed_.shown).value);
    const Ticks passed{std::llround(by_device / (1 + shown_.rate()))};
    const Ticks rounding{2 + std::llround(std::ceil(std::abs(by_device) * shown_.rate_error()))};
    const Ticks error = rounding + within + agreed_.within;
    const Ticks by = own - agreed_.own - passed;
    if (!stood_still_) { machine_.own_was_set(by, error); }
    shown_.own_was_set(by, error);
}

Ticks DeviceClocks::error_at(Tick machine) const {
    const Tick own = machine_.own_at(machine);
    return machine_.error(own) + shown_at(own).error;
}

/// Converts relative to the last look, by the rate of the clocks.
Tick DeviceClocks::to_machine(Tick device) const {
    const ClockView shown = shown_at(own_);
    const auto since = static_cast<double>((device - shown.other).value);
    return machine_.at(own_ + Ticks{std::llround(since / (1 + shown.rate))});
}

ClockView DeviceClocks::device_clock() const {
    if (is_one_clock()) { return {.own = device_, .other = device_, .error = machine_.error(device_)}; }
    const ClockView shown = shown_at(own_);
    const ClockView machine = machine_.estimate(own_);
    return {.own = shown.other,
            .other = machine.other,
            .rate = (1 + machine.rate) / (1 + shown.rate) - 1,
            .error = shown.error + machine.error,
            .rate_error = shown.rate_error + machine.rate_error};
}

}  // namespace lockstep
