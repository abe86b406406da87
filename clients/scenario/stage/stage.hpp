// A scenario from the curtain to the verdict: brings the machine up, plays, takes it down, judges.
#pragma once

#include "clients/scenario/scenario.hpp"

namespace lockstep::scenario {

/// In this process's world: see world.hpp. `keep`: an open directory into which the logs are copied; below 0: none.
proto::ScenarioReport play(const Scenario& scenario, int keep);

}  // namespace lockstep::scenario
