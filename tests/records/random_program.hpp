// Programs of random lines, arcs, helices, splines, cycles, short lines and dwells for the small mill.
#pragma once

#include <cstdint>
#include <string>

namespace lockstep::records {

/// The same seed gives the same G-code.
std::string random_gcode(std::uint64_t seed);
/// Straight lines under G64 on the small plotter, from a third of a step to some mm, that turn a little or sharply.
std::string random_lines(std::uint64_t seed);
/// Moves of the only axis of slow_axis_machine().
std::string random_moves_of_one_axis(std::uint64_t seed);

}  // namespace lockstep::records
