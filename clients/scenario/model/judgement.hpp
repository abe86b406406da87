// Whether what a scenario expects is true, by what is known of it. Pure.
#pragma once

#include <vector>

#include "clients/scenario/model/facts.hpp"
#include "clients/scenario/model/scenario.hpp"

namespace lockstep::scenario {

/// The log, of those that --keep keeps, that the others are merged into.
inline constexpr const char* kWholeLog = "whole.lcm";

/// One check for each thing expected, and for each rest that was awaited: what was asked, what was found, and where.
std::vector<Check> judge(const Scenario& scenario, const Seen& seen, const Evidence& evidence);

}  // namespace lockstep::scenario
