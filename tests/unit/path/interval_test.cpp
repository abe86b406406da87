// The bounds of one interval on the path's speed.
#include "core/path/interval.hpp"

#include <gtest/gtest.h>

#include "tests/property/path/path_run.hpp"

namespace lockstep {
namespace {

/// A straight piece whose joints turn an axis about as much as the piece itself goes along it. At the limit that its
/// charge sets, the slowest passage keeps its speed from interval to interval.
TEST(IntervalBounds, TheSlowestPassageNeverGetsFaster) {
    const PathSetup setup = setup_of(mill());
    JoinedPiece piece{.shape = {.length = 100, .is_straight = true}, .is_charged = true};
    for (const double slope : {80.0, 2.6, 0.0}) { piece.shape.slope.append(slope); }
    for (int axis = 0; axis < 3; ++axis) { piece.shape.bend.append(0); }
    piece.charged = piece.shape.bend;
    piece.charged[1] = -6;
    Interval part{.kind = IntervalKind::Curved};
    double w = 1;
    for (int k = 0; k < 400; ++k) {
        part.from = 0.25 * k;
        part.to = part.from + 0.25;
        const IntervalBounds bounds(setup, piece, part);
        if (k == 0) { w = (1 + 1e-12) * bounds.limit(); }  // rounded up
        const double least = bounds.least_after(w);
        ASSERT_LE(least, w) << "interval " << k;
        if (least <= 0) { break; }
        w = least;
    }
}

}  // namespace
}  // namespace lockstep
