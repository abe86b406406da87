// A machine that the configuration's rules allow, of any size, speed and timing.
#pragma once

#include "core/machine.hpp"
#include "tests/simulation/simtest/draw.hpp"

namespace lockstep::simtest {

MachineConfig draw_machine(Draw& draw, std::size_t axes);

}  // namespace lockstep::simtest
