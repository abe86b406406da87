// Outputs that programs switch: a laser whose power follows the speed, and digital ones.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Outputs at drawn motors and boards, and the words of programs that switch them. The random numbers are separate:
/// scenarios without outputs stay the same. A machine with coordination LAI has none.
void give_outputs(std::uint64_t seed, Scenario& scenario);

}  // namespace lockstep::simtest
