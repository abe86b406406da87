// How scenarios went, for a person and for the tools that read JUnit's XML.
#pragma once

#include <string>

#include "clients/scenario/model/facts.hpp"

namespace lockstep::scenario {

/// A line for what was asked, found and where, each; `story`: what happened, too. Without a newline at the end.
std::string to_text(const proto::ScenarioReport& report, bool story);

/// As JUnit has it: a test suite, a case for each scenario, what did not hold as its failure.
std::string junit_xml(const proto::ScenarioRunReport& report);

}  // namespace lockstep::scenario
