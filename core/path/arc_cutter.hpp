// Cuts arcs, helices and spirals into quadratic pieces.
//
// A quadratic with its ends on an arc and the right middle deviates from it by 0.008 r angle^3. Angles are halved until
// that is within the tolerance, so that only sums, products, quotients and roots are needed: the same pieces on every
// machine.
#pragma once

#include "core/path/path_setup.hpp"
#include "core/path/path_trail.hpp"
#include "core/path/primitive.hpp"

namespace lockstep {

/// In steps.
struct ArcEnds {
    AxisVector at;    // where the axes are: on whole steps behind a rest
    AxisVector from;  // where the arc begins by the program
    AxisVector to;
};

/// The pieces of an arc, added to `out` with a mark each. False, and nothing is added: its radius is a quarter of a
/// step or less, so that a straight line is as good.
bool cut_arc(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
             std::uint32_t block, PathTrail& out);

}  // namespace lockstep
