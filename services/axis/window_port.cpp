#include "services/axis/window_port.hpp"

#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {

/// While the device is in the middle of an update, the driver shows what it read before.
std::expected<std::optional<DeviceReading>, std::string> WindowPort::read(Tick own) {
    if (simulated_) { run_simulated(own); }
    const Tick asked = now(own);
    const auto status = driver_.read();
    if (!status) { return std::unexpected(status.error()); }
    if (newest_ && driver_.is_stale()) {
        newest_->status = *status;
    } else {
        newest_ = DeviceReading{*status, asked, now(own), driver_.abilities().behind};
    }
    return newest_;
}

void WindowPort::run_simulated(Tick until) {
    const auto run = [this](Tick at) { simulated_->advance(at); };
    touched_ ? touched_->advance(until, simulated_->plant(), run) : run(until);
}

std::expected<std::uint32_t, std::string> WindowPort::drain(const OnStep& on_step) {
    const auto captured = driver_.drain_capture(on_step);
    if (!captured) { return std::unexpected(captured.error()); }
    return static_cast<std::uint32_t>(driver_.abilities().capture_entries - *captured);
}

std::expected<void, std::string> WindowPort::drain_channels(const OnChannel& on_channel) {
    const auto drained = driver_.drain_events(on_channel);
    if (!drained) { return std::unexpected(drained.error()); }
    return {};
}

std::expected<DeviceDriver, std::string> find_device(RegisterWindow window, const MachineConfig& machine,
                                                     const MotorConfig& motor) {
    auto driver = DeviceDriver::attach(std::move(window), machine.tick_ns);
    if (!driver) { return driver; }
    if (auto lack = lack_of(driver->abilities(), machine, motor)) { return std::unexpected(std::move(*lack)); }
    return driver;
}

std::expected<DeviceDriver, std::string> attach_driver(RegisterWindow window, const MachineConfig& machine,
                                                       const MotorConfig& motor) {
    auto driver = find_device(std::move(window), machine, motor);
    if (!driver) { return driver; }
    const auto set = driver->set_up(setup_of(machine, motor));
    return set ? std::move(driver) : std::unexpected(set.error());
}

std::expected<std::unique_ptr<DevicePort>, std::string> simulated_port(const MachineConfig& machine,
                                                                       const MotorConfig& motor, Tick now,
                                                                       std::uint32_t domain) {
    const RegisterWindow window = RegisterWindow::in_process();
    auto device = std::make_unique<SimulatedDevice>(window, plant_of(machine, motor), machine.tick_ns, now,
                                                    static_cast<std::uint64_t>(now.value));
    auto driver = attach_driver(window, machine, motor);
    if (!driver) { return std::unexpected(driver.error()); }
    if (!TouchedDevice::is_needed(machine)) {
        return std::make_unique<WindowPort>(std::move(*driver), std::move(device));
    }
    auto touched = TouchedDevice::open(machine, domain, motor_named(machine, motor.name).value(), now);
    if (!touched) { return std::unexpected(touched.error()); }
    return std::make_unique<WindowPort>(std::move(*driver), std::move(device), std::move(*touched));
}

}  // namespace lockstep
