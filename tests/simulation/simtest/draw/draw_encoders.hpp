// Slides that are pushed, in machines whose motors make up lost steps at rest.
#pragma once

#include <cstdint>

#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Each motor bears up to some forty steps of following error, and makes up more than a few. The machine must have no
/// backlash.
MachineConfig with_encoders(std::uint64_t seed, MachineConfig machine);

/// Pushes before most programs, and in some that neither pause nor are interrupted. No other fault pushes slides, so
/// that the test knows how far each one is from its count.
void give_slips(std::uint64_t seed, Scenario& scenario);

}  // namespace lockstep::simtest
