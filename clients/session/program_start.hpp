// Where a program starts, as a person says it.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

/// "X=10,Y=5": parked, as after homing, but for the axes that it names. Error: what is wrong with it, and an example.
std::expected<std::vector<double>, std::string> places_at_start(const MachineConfig& machine, const std::string& start);

}  // namespace lockstep
