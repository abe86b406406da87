// The rules that the expectations must satisfy: names exist, numbers are within their limits, and no two of them
// contradict each other. See rules.hpp.
#pragma once

#include "clients/scenario/model/problems.hpp"

namespace lockstep::scenario {

void check_expectations(const Asked::Expect& expect, const MachineConfig& machine, Problems& problems);

}  // namespace lockstep::scenario
