// The registers of a device that is not simulated in the axis's own process, opened by the name in the configuration.
#pragma once

#include <expected>
#include <string>

#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// device: "shm:NAME" or "uio:PATH" (AxisConfig::device). Error: neither, or why it cannot be mapped.
std::expected<RegisterWindow, std::string> open_window(const std::string& device);

}  // namespace lockstep
