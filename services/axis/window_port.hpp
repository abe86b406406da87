// The port to a device with a register window in memory: of another process, of hardware, or of a simulation in this
// process.
#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/kinematics/motors.hpp"
#include "core/machine.hpp"
#include "services/axis/device_driver.hpp"
#include "services/axis/device_port.hpp"
#include "sim_fpga/contacts/touched_device.hpp"
#include "sim_fpga/device.hpp"

namespace lockstep {

class WindowPort : public DevicePort {
public:
    /// Reads the clock of this process.
    using ReadClock = std::function<Tick()>;

    /// A device that counts the host's clock. `simulated`: the device itself, if it is simulated in this process. It
    /// runs up to the present whenever it is read.
    /// `touched`: what the machine's slides touch, if they touch something.
    explicit WindowPort(DeviceDriver driver, std::unique_ptr<SimulatedDevice> simulated = nullptr,
                        std::optional<TouchedDevice> touched = std::nullopt)
        : driver_(std::move(driver)), simulated_(std::move(simulated)), touched_(std::move(touched)) {}
    /// A device with a clock of its own. `host_clock` is read before and after the registers.
    WindowPort(DeviceDriver driver, ReadClock host_clock)
        : driver_(std::move(driver)), host_clock_(std::move(host_clock)) {}

    DeviceClock clock() const override { return host_clock_ ? DeviceClock::Own : DeviceClock::Host; }
    std::expected<std::optional<DeviceReading>, std::string> read(Tick own) override;
    std::expected<void, std::string> apply(const DeviceOrder& order) override { return driver_.apply(order); }
    std::expected<std::uint32_t, std::string> drain(const OnStep& on_step) override;
    std::uint64_t lost_captures() const override { return driver_.lost_captures(); }
    std::expected<void, std::string> drain_channels(const OnChannel& on_channel) override;
    std::uint64_t lost_channel_events() const override { return driver_.lost_events(); }

private:
    void run_simulated(Tick until);
    Tick now(Tick own) const { return host_clock_ ? host_clock_() : own; }

    DeviceDriver driver_;
    std::unique_ptr<SimulatedDevice> simulated_;
    std::optional<TouchedDevice> touched_;
    ReadClock host_clock_;  // empty: the device counts it
    std::optional<DeviceReading> newest_;
};

/// A driver to the device behind these registers. It changes nothing. Errors: those of DeviceDriver::attach; a device
/// that cannot do what this motor of the machine needs.
std::expected<DeviceDriver, std::string> find_device(RegisterWindow window, const MachineConfig& machine,
                                                     const MotorConfig& motor);
/// The same, and sets the device up for the motor.
std::expected<DeviceDriver, std::string> attach_driver(RegisterWindow window, const MachineConfig& machine,
                                                       const MotorConfig& motor);

/// The port to a device that is simulated in this process, powered up at `now`. `domain`: of the machine's network.
/// Errors: those of attach_driver and TouchedDevice::open.
std::expected<std::unique_ptr<DevicePort>, std::string> simulated_port(const MachineConfig& machine,
                                                                       const MotorConfig& motor, Tick now,
                                                                       std::uint32_t domain = 0);

}  // namespace lockstep
