// The start position of a program, from a command line.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

/// "X=10,Y=5": the named axes there, the others parked as after homing. Error: what is wrong with it, and an example.
std::expected<std::vector<double>, std::string> places_at_start(const MachineConfig& machine, const std::string& start);

}  // namespace lockstep
