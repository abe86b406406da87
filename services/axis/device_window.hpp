// Opens the registers of a device that is not simulated in the axis's own process, by its name in the configuration.
#pragma once

#include <expected>
#include <string>

#include "core/device/device_name.hpp"
#include "services/setup/machine_setup.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// `device` is not simulated. Error: the registers cannot be mapped; for a linked device also: lockstep-board does not
/// run, or its board does not answer or has no such motor.
std::expected<RegisterWindow, std::string> open_window(const DeviceName& device, const MachineSetup& machine);

/// The end of a message about a linked device that does not answer: which cable to check.
std::string link_remedy(const DeviceName& device, const MachineSetup& machine);

}  // namespace lockstep
