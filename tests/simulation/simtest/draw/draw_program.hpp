// A program within a machine's travel: single steps to full travel, rapids and feeds, corners of all angles, reversals,
// short polylines, dwells and pauses.
#pragma once

#include "core/machine.hpp"
#include "core/program.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {

Program draw_program(Draw& draw, const MachineConfig& machine);

/// Appends a smooth curve or a line, in chords of a fraction of a step and more.
Program with_dense_curve(Draw& draw, const MachineConfig& machine, Program program);

/// Gives the moves path modes and fixed feeds, puts events between them, and appends arcs.
Program with_curves(Draw& draw, const MachineConfig& machine, Program program);

}  // namespace lockstep::simtest
