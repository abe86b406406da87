// Runs one scenario: brings its machine up, executes the steps, takes the machine down, evaluates the expectations.
#pragma once

#include <optional>

#include "clients/scenario/model/scenario.hpp"
#include "clients/scenario/runner/containers.hpp"

namespace lockstep::scenario {

/// Call it inside a sandbox (sandbox.hpp). `containers` is required for a scenario in containers. `keep` is the
/// descriptor of an open directory into which the logs are copied, or negative.
proto::ScenarioReport run_scenario(const Scenario& scenario, const std::optional<Containers>& containers, int keep);

}  // namespace lockstep::scenario
