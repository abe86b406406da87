// Programs that are sent while they run.
#pragma once

#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Cuts a task's program into parts, with times between them that starve the machine or do not. Some parts end with a
/// rest, as a sender's that has no more for now.
void send_in_parts(Draw& draw, Task& task);

}  // namespace lockstep::simtest
