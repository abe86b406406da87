// Every motion of a program as a table, before arcs are cut into chords.
#pragma once

#include <expected>
#include <string>

#include "clients/lockstep/offline/program_input.hpp"

namespace lockstep {

/// Columns: line, kind, one for each axis (machine coordinates, mm or degrees), feed_mm_min, i, j, k.
/// Kinds: rapid, feed, arc_cw, arc_ccw, dwell, probe. i, j, k: an arc's centre, in machine coordinates too; an arc of
/// several turns has a row for each. A spline's chords are of kind feed. Cells that say nothing are empty.
std::string moves_csv(const ProgramInput& input);

}  // namespace lockstep
