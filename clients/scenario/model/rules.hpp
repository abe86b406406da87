// What a scenario must satisfy before it is played: what is named is there, numbers are within their limits, nothing
// contradicts itself.
#pragma once

#include "clients/scenario/model/scenario.hpp"
#include "services/documents/text_source.hpp"

namespace lockstep::scenario {

/// In the order of the text; each names the value, the limit and the remedy. Empty: it can be played.
Diagnostics rule_errors(const Scenario& scenario, const TextSource& source);

}  // namespace lockstep::scenario
