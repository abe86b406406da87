// Opens the registers of a device that is not simulated in the axis's own process, by its name in the configuration.
#pragma once

#include <expected>
#include <string>

#include "core/device/device_name.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// `device` is shared or mapped, not simulated. Error: the registers cannot be mapped.
std::expected<RegisterWindow, std::string> open_window(const DeviceName& device);

}  // namespace lockstep
