// Evaluates the expectations of a scenario against its results. Does no I/O.
#pragma once

#include <vector>

#include "clients/scenario/model/facts.hpp"
#include "clients/scenario/model/scenario.hpp"

namespace lockstep::scenario {

/// The file with all logs merged. --keep keeps it among the others.
inline constexpr const char* kWholeLog = "whole.lcm";

/// Returns one check for each expectation, awaited rest and awaited output: the expectation, the result, and its
/// source.
std::vector<Check> evaluate(const Scenario& scenario, const Observations& observed, const Evidence& evidence);

}  // namespace lockstep::scenario
