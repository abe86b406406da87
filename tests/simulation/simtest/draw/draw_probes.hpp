// Probing moves with a probe that touches at any time.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Gives the machine a probe with one or two inputs at devices, and adds jobs that probe. Call it after all other
/// inputs are given.
void give_probes(std::uint64_t seed, Scenario& scenario);

}  // namespace lockstep::simtest
