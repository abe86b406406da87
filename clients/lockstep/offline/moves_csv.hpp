// Writes every motion of a program to a table, before arcs are cut into chords.
#pragma once

#include <expected>
#include <string>

#include "core/gcode/gcode.hpp"

namespace lockstep {

/// `program` must have no errors. It may be of any length, because a long one is read while the table is written.
/// `setup`: the setup that it was planned with. Fails if the table cannot be written, and removes it then.
///
/// Columns: line, kind, one for each axis (machine coordinates, mm or degrees), feed_mm_min, i, j, k.
/// Kinds: rapid, feed, arc_cw, arc_ccw, dwell, probe. i, j, k are an arc's centre, in machine coordinates. An arc of
/// several turns has a row for each turn. A spline's chords are of kind feed. Cells without a value are empty.
std::expected<void, std::string> write_moves(const std::string& table, const std::string& program,
                                             const GcodeSetup& setup);

}  // namespace lockstep
