// Changes the machine's values that outlive programs.
#pragma once

#include <expected>

#include "clients/session/session.hpp"

namespace lockstep {

/// A program that has nothing to run, to carry values.
Program edit_of(const MachineConfig& machine);

/// Sends `wanted` and sets `values` to it. Waits until the coordinator has it on its disk.
std::expected<void, Failure> store_values(Session& session, RevisedValues& values, const gcode::KeptValues& wanted);

}  // namespace lockstep
