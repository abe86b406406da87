// The results of scenarios, for a person and for tools that read JUnit's XML.
#pragma once

#include <string>

#include "clients/scenario/model/facts.hpp"

namespace lockstep::scenario {

/// A line for each check: expected, found, source. With `events`, also the events with their times. No newline at the
/// end.
std::string to_text(const proto::ScenarioReport& report, bool events);

/// In JUnit's format: a test suite, a case for each scenario, its failed checks as its failure.
std::string junit_xml(const proto::ScenarioRunReport& report);

}  // namespace lockstep::scenario
