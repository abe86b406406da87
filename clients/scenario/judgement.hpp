// Whether what a scenario expects is true, by what is known of it. Pure.
#pragma once

#include <vector>

#include "clients/scenario/facts.hpp"
#include "clients/scenario/scenario.hpp"

namespace lockstep::scenario {

/// The logs, as --keep keeps them.
inline constexpr const char* kWholeLog = "whole.lcm";
inline constexpr const char* kIncidents = "incidents";

/// One check for each thing expected, and for each rest that was awaited: what was asked, what was found, and where.
std::vector<Check> judge(const Scenario& scenario, const Seen& seen, const Evidence& evidence);

}  // namespace lockstep::scenario
