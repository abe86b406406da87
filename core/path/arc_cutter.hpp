// Cuts arcs, helices and spirals into quadratic pieces.
//
// A quadratic through the ends and the middle of an arc deviates from it by 0.008 r angle^3. Angles are halved until
// that is within the tolerance. This needs only sums, products, quotients and roots, so the pieces are the same on
// every machine.
#pragma once

#include "core/path/path_setup.hpp"
#include "core/path/path_trail.hpp"
#include "core/path/primitive.hpp"

namespace lockstep {

/// In steps.
struct ArcEnds {
    AxisVector at;    // where the axes are: on whole steps after a rest
    AxisVector from;  // the programmed begin of the arc
    AxisVector to;
};

/// Adds the pieces of an arc to `out`, each with a mark. Returns false and adds nothing if its radius is a quarter of a
/// step or less; then a straight line is good enough.
bool cut_arc(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
             std::uint32_t block, PathTrail& out);

}  // namespace lockstep
