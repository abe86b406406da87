#include "core/outputs/reported_outputs.hpp"

#include <cmath>

#include "core/outputs/output_levels.hpp"

namespace lockstep {
namespace {

double level_of(const OutputConfig& output, const AxisState& device) {
    return device.analog[static_cast<std::size_t>(output.channel)];
}

/// Whether the device has the places of the program's last word. Its number is of an older word before.
bool has_places(const AxisState& device, const MachineState& machine) {
    return !machine.devices_after && device.epoch == machine.epoch && device.ran > 0;
}

}  // namespace

bool reports_on(const OutputConfig& output, const AxisState& device) { return (device.outputs & output.bit()) != 0; }

double reported_share(const OutputConfig& output, const AxisState& device) {
    return level_of(output, device) / kFullAnalogLevel;
}

bool is_reported(double share, const OutputConfig& output, const AxisState& device) {
    return std::abs(share * kFullAnalogLevel - level_of(output, device)) <= 1;
}

bool reports_active(const OutputConfig& output, const AxisState& device) {
    if (output.is_analog()) { return level_of(output, device) > 0; }
    return output.has_level() && reports_on(output, device);
}

std::optional<std::uint32_t> pulses_left(const OutputConfig& output, const MachineState& machine,
                                         const AxisState* device) {
    if (!output.makes_pulses() || !is_active(output, machine.devices)) { return std::nullopt; }
    return device != nullptr && has_places(*device, machine) ? device->pulses_left : machine.devices.pulses.left;
}

}  // namespace lockstep
