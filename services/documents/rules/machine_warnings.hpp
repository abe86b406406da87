// Warnings about a valid configuration.
#pragma once

#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

/// One text for each axis that G-code cannot name, with the effect and the remedy. Pure.
std::vector<std::string> machine_warnings(const MachineConfig& machine);

}  // namespace lockstep
