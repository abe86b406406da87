// Cuts arcs, helices and spirals into quadratic pieces.
//
// A quadratic with its ends on an arc and the right middle deviates from it by 0.008 r angle^3. Angles are halved until
// that is within the tolerance, so that only sums, products, quotients and roots are needed: the same pieces on every
// machine.
#pragma once

#include <expected>
#include <string>

#include "core/path/path_setup.hpp"
#include "core/path/path_trail.hpp"
#include "core/path/primitive.hpp"

namespace lockstep {

/// The pieces of an arc from `from` (steps), added to `out` with a mark each. Error: its ends are not on one circle or
/// spiral about the centre: a radius is 0.
std::expected<void, std::string> cut_arc(const PathSetup& setup, const PathArc& arc, const AxisVector& from,
                                         const MoveSettings& settings, std::uint32_t block, PathTrail& out);

}  // namespace lockstep
