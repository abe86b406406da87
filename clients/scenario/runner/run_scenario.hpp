// Runs one scenario: brings its machine up, executes the steps, takes the machine down, evaluates the expectations.
#pragma once

#include <optional>

#include "clients/scenario/model/scenario.hpp"
#include "clients/scenario/runner/containers.hpp"

namespace lockstep::scenario {

/// In the sandbox of this process (sandbox.hpp). `containers`: for a scenario in containers. `keep`: an open directory
/// into which the logs are copied; below 0: none.
proto::ScenarioReport run_scenario(const Scenario& scenario, const std::optional<Containers>& containers, int keep);

}  // namespace lockstep::scenario
