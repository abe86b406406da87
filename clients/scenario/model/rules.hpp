// The rules that a scenario must satisfy before it runs: every name exists, numbers are within their limits, no
// contradictions.
#pragma once

#include "clients/scenario/model/scenario.hpp"
#include "services/documents/text/text_source.hpp"

namespace lockstep::scenario {

/// Returns the errors in the order of the text; each names the value, the limit and the remedy. Empty if the scenario
/// can run.
Diagnostics rule_errors(const Scenario& scenario, const TextSource& source);

}  // namespace lockstep::scenario
