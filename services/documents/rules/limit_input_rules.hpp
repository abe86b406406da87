// The rules of limit switches that are wired to inputs: by use, `axis` and device.
#pragma once

#include <string>

#include "core/kinematics/motors.hpp"
#include "core/machine.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {

/// `motor`: whose device has the input; null if the machine has none of its name. at: the place of the input, such as
/// "input[0].".
void check_limit_input(const MachineConfig& machine, const InputConfig& input, const MotorConfig* motor,
                       const std::string& at, ProblemList& problems);

}  // namespace lockstep
