// What an operator moves by hand before a homing, where no switch could help.
#pragma once

#include "tests/simulation/simtest/run/bench.hpp"

namespace lockstep::simtest {

/// Puts axes that are homed in place to their park, and axes that rest outside their travel back to its end. Returns
/// when the machine has noticed it: a motor that is still homed then has a fault.
void move_slides_before_homing(Bench& bench);

}  // namespace lockstep::simtest
