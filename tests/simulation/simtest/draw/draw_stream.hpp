// Programs that are sent while they run.
#pragma once

#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Cuts a task's program into parts. Some times between the parts are so long that the machine runs out of blocks. Some
/// parts end with a rest, like those of a sender that has no more blocks for now.
void send_in_parts(Draw& draw, Task& task);

}  // namespace lockstep::simtest
