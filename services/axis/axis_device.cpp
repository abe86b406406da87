#include "services/axis/axis_device.hpp"

namespace lockstep {

void AxisDevice::seek(Tick own) {
    const Ticks period{std::chrono::nanoseconds(kSeekPeriod).count() / machine_.tick_ns};
    if (found_ || (sought_ && own >= *sought_ && own - *sought_ < period)) { return; }
    sought_ = own;
    auto port = open_(own);
    if (!port) {
        lacks_ = port.error();
        return;
    }
    found_.emplace(Found{.port = std::move(*port), .watch = DeviceWatch(machine_), .newest = {}, .first = {}});
}

/// Before a failed device is closed, it is ordered to rest, in case it still runs.
void AxisDevice::lose(Tick own, const std::string& why) {
    (void)found_->port->apply(device::Veto{1});
    troubles_ += is_present() ? 1 : 0;
    changed_ = changed_ || is_present();
    found_.reset();
    status_.moving = false;
    status_.finished = true;
    lost_before_ += std::exchange(lost_captures_, 0);
    sought_ = own;
    lacks_ = why;
}

void AxisDevice::read(Tick own) {
    if (!found_) { return; }
    const auto reading = found_->port->read(own);
    if (!reading) { return lose(own, reading.error()); }
    const auto doubt = *reading ? found_->watch.doubt_of(own, (*reading)->status) : found_->watch.doubt_of_silence(own);
    if (doubt) { return lose(own, "device: " + *doubt + found_->port->remedy()); }
    if (!*reading) { return; }
    found_->is_new = !found_->newest || found_->newest->asked != (*reading)->asked;
    found_->newest = *reading;
    status_ = (*reading)->status;
    found_->first = found_->first.value_or(status_.now);
    if (found_->lives || status_.now == *found_->first) { return; }
    found_->lives = true;
    changed_ = true;
}

void AxisDevice::drain_channels(Tick own, const DevicePort::OnChannel& on_channel) {
    if (!is_present()) { return; }
    const auto drained = found_->port->drain_channels(on_channel);
    if (!drained) { lose(own, drained.error()); }
}

std::optional<std::uint32_t> AxisDevice::drain(Tick own, const DevicePort::OnStep& on_step) {
    if (!is_present()) { return std::nullopt; }
    const auto free_captures = found_->port->drain(on_step);
    if (!free_captures) {
        lose(own, free_captures.error());
        return std::nullopt;
    }
    lost_captures_ = found_->port->lost_captures();
    return *free_captures;
}

void AxisDevice::give(const std::vector<DeviceOrder>& orders) {
    for (const DeviceOrder& order : orders) {
        if (!is_present()) { return; }
        const auto given = found_->port->apply(order);
        if (given) {
            found_->watch.take(order);
            continue;
        }
        trouble_ = given.error();
        ++troubles_;
        failed_ = true;
    }
}

std::optional<DeviceClocks::Device> AxisDevice::clock() const {
    if (!is_present()) { return std::nullopt; }
    DeviceClocks::Device device{found_->port->clock(), {}};
    if (found_->is_new) { device.reading = exchange_of(*found_->newest); }
    return device;
}

}  // namespace lockstep
