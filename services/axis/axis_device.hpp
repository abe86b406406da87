// The device of an axis: found, read, given its orders, lost after an error, and searched for again.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/axis/device/device_watch.hpp"
#include "core/axis/device_clocks.hpp"
#include "services/axis/device_port.hpp"

namespace lockstep {

/// Opens an axis's device. `own` is the current reading of this process's clock. Error: why there is no device. Never
/// waits.
using OpenDevice = std::function<std::expected<std::unique_ptr<DevicePort>, std::string>(Tick own)>;

class AxisDevice {
public:
    /// While the device is missing or lost, it is searched for every kSeekPeriod.
    AxisDevice(const MachineConfig& machine, OpenDevice open) : open_(std::move(open)), machine_(machine) {}
    static constexpr std::chrono::milliseconds kSeekPeriod{200};

    // Call these functions in each loop, in this order. `own`: the reading of this process's clock.
    void seek(Tick own);
    void read(Tick own);
    /// Passes every change of an input or output since the last loop, in order, in the device's time.
    void drain_channels(Tick own, const DevicePort::OnChannel& on_channel);
    /// Passes every step since the last loop in the same way. Returns for how many further steps the device had room;
    /// nullopt without a device.
    std::optional<std::uint32_t> drain(Tick own, const DevicePort::OnStep& on_step);
    void give(const std::vector<DeviceOrder>& orders);

    /// A device was found, and its clock advances.
    bool is_present() const { return found_ && found_->lives; }
    /// A device was found, and it is not clear yet whether it lives: the memory of a dead device looks the same, but
    /// its clock stands still.
    bool is_in_doubt() const { return found_ && !found_->lives; }
    /// Why there is no device.
    const std::string& lacks() const { return lacks_; }
    /// The last status read, in the device's time.
    const DeviceStatus& status() const { return status_; }
    /// The device's clock in this loop; nullopt without a device.
    std::optional<DeviceClocks::Device> clock() const;
    /// Whether a device was found or lost since the last call.
    bool take_change() { return std::exchange(changed_, false); }
    /// Whether it has refused an order since the last call.
    bool take_failure() { return std::exchange(failed_, false); }

    /// Number of errors so far: refused orders and lost devices.
    std::uint64_t troubles() const { return troubles_; }
    /// The error of the last order that the device refused; empty if it refused none.
    const std::string& trouble() const { return trouble_; }
    std::uint64_t lost_captures() const { return lost_before_ + lost_captures_; }
    std::uint64_t lost_channel_events() const { return is_present() ? found_->port->lost_channel_events() : 0; }

private:
    void lose(Tick own, const std::string& why);

    struct Found {
        std::unique_ptr<DevicePort> port;
        DeviceWatch watch;
        std::optional<DeviceReading> newest;
        bool is_new = false;        // `newest` was not there in the loop before
        std::optional<Tick> first;  // its first clock reading
        bool lives = false;         // its clock advances
    };

    OpenDevice open_;
    MachineConfig machine_;
    std::optional<Found> found_;
    std::optional<Tick> sought_;  // last search, on this process's clock; nullopt: search at once
    std::string lacks_ = "not searched for yet";
    DeviceStatus status_;
    bool changed_ = false;
    bool failed_ = false;
    std::uint64_t lost_captures_ = 0;  // of this device
    std::uint64_t lost_before_ = 0;    // of the devices before it
    std::string trouble_;
    std::uint64_t troubles_ = 0;
};

}  // namespace lockstep
