// Writes offsets and tools as text. Pure.
#pragma once

#include <string>

#include "core/gcode/kept_values.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// A line for each coordinate system that is set, and for G92, G28 and G30.
std::string offsets_text(const MachineSetup& machine, const gcode::KeptValues& values);
/// A line for each tool.
std::string tools_text(const MachineSetup& machine, const gcode::KeptValues& values);

}  // namespace lockstep
