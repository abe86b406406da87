// A scenario from the curtain to the verdict: brings the machine up, plays, takes it down, judges.
#pragma once

#include <optional>

#include "clients/scenario/model/scenario.hpp"
#include "clients/scenario/runner/containers.hpp"

namespace lockstep::scenario {

/// In this process's world: see world.hpp. `containers`: for a scenario in containers. `keep`: an open directory into
/// which the logs are copied; below 0: none.
proto::ScenarioReport play(const Scenario& scenario, const std::optional<Containers>& containers, int keep);

}  // namespace lockstep::scenario
