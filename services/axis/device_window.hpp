// Opens the registers of a device that is not simulated in the axis's own process, by its name in the configuration.
#pragma once

#include <expected>
#include <string>

#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// `device` is "shm:NAME" or "uio:PATH" (AxisConfig::device). Error: `device` is neither, or the registers cannot be
/// mapped.
std::expected<RegisterWindow, std::string> open_window(const std::string& device);

}  // namespace lockstep
