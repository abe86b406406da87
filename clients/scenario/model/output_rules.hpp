// The rules for what outputs do after an act: they exist, times are within their limits, and their device outlives the
// act. See rules.hpp.
#pragma once

#include "clients/scenario/model/problems.hpp"

namespace lockstep::scenario {

/// `path`: the place of the event in the scenario.
void check_outputs(const Asked::During& during, const std::string& path, const Scenario& scenario, Problems& problems);

}  // namespace lockstep::scenario
