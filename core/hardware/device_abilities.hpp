// What a device is built for, and what a motor needs of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/kinematics/motors.hpp"
#include "core/machine.hpp"
#include "core/units.hpp"

namespace lockstep {

/// The words of a device's registers that never change (sim_fpga/registers.json). By default those of a simulated one.
struct DeviceAbilities {
    std::uint64_t segment_entries = 2048;
    std::uint64_t capture_entries = 65'536;
    Ticks least_step{2};  // from one step to the next
    bool operator==(const DeviceAbilities&) const = default;
};

/// The least abilities with which a device can move this motor of the machine.
DeviceAbilities needs_of(const MachineConfig& machine, const MotorConfig& motor);

/// What the device cannot do that the motor needs, with the values and the remedy; nullopt if it can do everything.
std::optional<std::string> lack_of(const DeviceAbilities& device, const MachineConfig& machine,
                                   const MotorConfig& motor);

}  // namespace lockstep
