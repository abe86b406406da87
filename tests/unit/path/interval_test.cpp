// The bounds of one interval on the path's speed.
#include "core/path/interval.hpp"

#include <gtest/gtest.h>

#include "tests/property/path/path_run.hpp"

namespace lockstep {
namespace {

/// The joints of a straight piece turn an axis about as much as this axis moves along the piece. At the speed limit
/// that the charge for the joints sets, the slowest passage keeps its speed from interval to interval.
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

/// Checks the acceleration x'' = x' u'' + x'' u'^2 at places of an interval that is passed as fast as its bounds allow.
TEST(IntervalBounds, AxesKeepTheirAccelerationsFromEndToEnd) {
    const PathSetup setup = setup_of(mill());
    Random random(19);
    for (int n = 0; n < 2'000; ++n) {
        JoinedPiece piece{.shape = {.length = 0.25, .is_straight = false}};
        for (const double scale : setup.steps_per_mm) {
            piece.shape.slope.append(uniform(random, -scale, scale));
            piece.shape.bend.append(uniform(random, -scale, scale) / 4);
        }
        const Interval part{.kind = IntervalKind::Curved, .from = 0, .to = 0.25};
        const IntervalBounds bounds(setup, piece, part);
        const double w0 = bounds.limit() * uniform(random, 0, 1);
        const double w1 = n % 2 == 0 ? bounds.after(w0) : std::max(0.0, bounds.least_after(w0));
        if (w0 > bounds.before(w1)) { continue; }  // this speed is too high for the interval
        for (std::size_t axis = 0; axis < setup.axes(); ++axis) {
            for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                const double w = w0 + share * (w1 - w0);
                const double slope = piece.shape.slope_at(axis, share * 0.25);
                const double acceleration = slope * (w1 - w0) / 0.5 + piece.shape.bend[axis] * w;
                ASSERT_LE(std::abs(acceleration), setup.limits[axis].max_acceleration * (1 + 1e-9))
                    << n << " " << share;
            }
        }
    }
}

}  // namespace
}  // namespace lockstep
