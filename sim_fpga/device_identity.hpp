// The registers that a device writes once, at its power-up: which map this is, and what the device is built for.
#pragma once

#include <cstdint>

#include "core/hardware/device_abilities.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

class DeviceIdentity {
public:
    DeviceIdentity(RegisterWindow window, std::int64_t tick_ns, std::uint64_t power_up)
        : window_(window), tick_ns_(static_cast<std::uint64_t>(tick_ns)), power_up_(power_up) {}

    /// Also resets the host's words. The window is not a device's before show().
    void store(const DeviceAbilities& abilities);
    void show() { window_.store(registers::kMagic, registers::kMagicValue); }
    /// Whether the registers are still those of this device.
    bool is_intact() const;

private:
    RegisterWindow window_;
    std::uint64_t tick_ns_;
    std::uint64_t power_up_;
};

}  // namespace lockstep
