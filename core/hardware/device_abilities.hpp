// The abilities of a device, and those that a motor needs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/hardware/device_setup.hpp"
#include "core/kinematics/motors.hpp"
#include "core/machine.hpp"
#include "core/step/executable.hpp"
#include "core/units.hpp"

namespace lockstep {

/// The words of a device's registers that never change (sim_fpga/registers.json). By default those of a simulated one.
struct DeviceAbilities {
    std::uint64_t segment_entries = 2048;
    std::uint64_t capture_entries = 65'536;
    Ticks least_step{2};  // from one step to the next
    Ticks longest_piece = kMaxPieceTicks;
    Ticks lead;                         // so long before its start a frame must be loaded and armed
    Ticks behind;                       // so long behind its ticks the pins are, at most
    std::uint64_t time_unit_ps = 1000;  // of pulse times and PWM periods
    std::uint64_t longest_time = 1'000'000'000;
    std::uint64_t longest_pwm_period = 1'000'000'000;
    std::uint64_t inputs = 8;
    std::uint64_t digital_outputs = 8;
    std::uint64_t analog_outputs = 2;
    std::uint64_t output_entries = 1024;
    std::uint64_t event_entries = 1024;
    bool has_encoder = true;
    bool can_enable = true;
    bool can_compare = true;
    bool frames_stay = false;  // in the segment ring until they end
    bool operator==(const DeviceAbilities&) const = default;
};

/// The most by which a device may execute ahead of what the host has written and of its pins, together. A slot has room
/// for it beside clock errors; the other half of the room is the network's (core/protocol/rules.hpp).
Ticks most_lead(const MachineConfig& machine);

/// The least abilities with which a device can move this motor of the machine.
DeviceAbilities needs_of(const MachineConfig& machine, const MotorConfig& motor);

/// The first need of the motor that the device cannot meet, its setup included, with the values and the remedy; nullopt
/// if it meets all.
std::optional<std::string> lack_of(const DeviceAbilities& device, const MachineConfig& machine,
                                   const MotorConfig& motor);
/// The same for a setup.
std::optional<std::string> lack_of(const DeviceAbilities& device, const DeviceSetup& setup);

/// How a device is set up for this motor of the machine.
DeviceSetup setup_of(const MachineConfig& machine, const MotorConfig& motor);

}  // namespace lockstep
