// A program within a machine's travel: single steps to full travel, rapids and feeds, corners of all angles, reversals,
// short polylines, dwells and pauses.
#pragma once

#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {

Program draw_program(Draw& draw, const MachineConfig& machine);

}  // namespace lockstep::simtest
