// Jogs between programs.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Jogs of one axis or several, with and without a distance, that end by a release, by silence, or by other keys, with
/// the requested faults. The random numbers are separate: scenarios without jogs stay the same.
void give_jogs(std::uint64_t seed, const FaultKinds& faults, Scenario& scenario);

}  // namespace lockstep::simtest
