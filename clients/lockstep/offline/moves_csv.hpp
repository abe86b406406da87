// Every motion of a program as a table, before arcs are cut into chords.
#pragma once

#include <expected>
#include <string>

#include "core/gcode/gcode.hpp"

namespace lockstep {

/// Of a program without errors, which is read as it is written: it may be of any length. `setup`: that it was planned
/// with. Error: the table cannot be written, and why; there is none then.
///
/// Columns: line, kind, one for each axis (machine coordinates, mm or degrees), feed_mm_min, i, j, k.
/// Kinds: rapid, feed, arc_cw, arc_ccw, dwell, probe. i, j, k: an arc's centre, in machine coordinates too; an arc of
/// several turns has a row for each. A spline's chords are of kind feed. Cells that say nothing are empty.
std::expected<void, std::string> write_moves(const std::string& table, const std::string& program,
                                             const GcodeSetup& setup);

}  // namespace lockstep
