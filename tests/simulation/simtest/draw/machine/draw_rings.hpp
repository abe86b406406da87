// Devices with small rings, of different sizes.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Draws how many entries the smallest segment ring has, from the least number that a timing allows on, and frames as
/// short as it allows or longer.
MachineConfig with_small_rings(std::uint64_t seed, MachineConfig machine);

/// Gives the motors' devices rings with as many entries as the machine needs, or up to four times as many.
void give_rings(std::uint64_t seed, Scenario& scenario);

}  // namespace lockstep::simtest
