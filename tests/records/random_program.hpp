// Programs of random lines, arcs, helices, splines, cycles, short lines and dwells for the small mill.
#pragma once

#include <cstdint>
#include <string>

namespace lockstep::records {

/// The same seed gives the same G-code.
std::string random_gcode(std::uint64_t seed);

}  // namespace lockstep::records
