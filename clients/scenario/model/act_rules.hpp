// The rules that an act must satisfy: see rules.hpp.
#pragma once

#include <string>
#include <vector>

#include "clients/scenario/model/problems.hpp"

namespace lockstep::scenario {

/// `path`: the act's place in the scenario. `processes`: those of the machine.
void check_act(const Asked::Act& act, const std::string& path, const Asked& asked, const MachineConfig& machine,
               const std::vector<std::string>& processes, Problems& problems);

}  // namespace lockstep::scenario
