// Warnings about a valid configuration.
#pragma once

#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

/// Axes that G-code cannot name, and simulated motors that are weaker than their axis's limits. Each text has the
/// effect and the remedy. Pure.
std::vector<std::string> machine_warnings(const MachineConfig& machine);

}  // namespace lockstep
