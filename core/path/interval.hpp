// A short part of a piece of geometry, in which the square of the speed is linear in the way.
//
// With t the slope of an axis at the interval's middle, c its bend, d the interval's length and w = (du/dt)^2 at its
// ends, the axis's acceleration changes steadily along the interval, from
//
//     (w1 (t - c d / 2) - w0 (t - 5 c d / 2)) / 2d    to    (w1 (t + 5 c d / 2) - w0 (t + c d / 2)) / 2d.
//
// Both may be from -a to a. These bounds on (w0, w1) are linear and hold at (0, 0): if w0 can be followed by w1, then
// every share of w0 by the same share of w1. So a backward pass that finds the greatest w of each node from which rest
// can be reached, and a forward pass that is as fast as those allow, are exact: H. Pham, Q.-C. Pham, "A New Approach to
// Time-Optimal Path Parameterization Based on Reachability Analysis", IEEE T-RO 34 (2018).
//
// On a straight piece the limits are the same everywhere. It is one interval: speeding up, cruising, braking.
#pragma once

#include <span>

#include "core/overrides.hpp"
#include "core/path/path_setup.hpp"
#include "core/path/quadratic.hpp"

namespace lockstep {

/// A piece with what its joints cost.
struct JoinedPiece {
    Quadratic shape;
    bool is_charged = false;     // the jumps at its ends are paid for like curvature: by `charged` in place of bend
    AxisVector charged;          // steps per mm^2
    double begin_cap = 0x1p100;  // w at its joints, where that is better: so slow that the piece recovers their jumps
    double end_cap = 0x1p100;
};

/// Whether speed changes steadily from end to end (Curved), or rises, is constant and falls (Straight).
enum class IntervalKind : std::uint8_t { Straight, Curved, Rest };

struct Interval {
    IntervalKind kind = IntervalKind::Curved;
    std::size_t piece = 0;  // number since the beginning of the stream
    double from = 0;        // u, mm
    double to = 0;
    double cap = 0;           // w at its beginning that limits and joint allow, mm^2 per tick^2
    double top = 0;           // w anywhere in it: Straight
    double acceleration = 0;  // mm per tick^2: Straight
    double deceleration = 0;
    double turn = 0;   // at its beginning: the greatest jump of an axis over its start velocity, per mm per tick
    double joint = 0;  // w that the jump at its beginning allows
    double reach = 0;  // w at its beginning from which all that follows can be kept

    double length() const { return to - from; }
};

/// The bounds of one interval on the squares of speed at its ends.
class IntervalBounds {
public:
    IntervalBounds(const PathSetup& setup, const JoinedPiece& piece, const Interval& interval)
        : setup_(setup), piece_(piece), interval_(interval) {}

    /// The greatest w at the beginning that can be followed by `w1` at the end.
    double before(double w1) const;
    /// The greatest w at the end that can follow `w0`.
    double after(double w0) const;
    /// The least w at the end that can follow `w0`; below 0: it can come to rest within.
    double least_after(double w0) const;
    /// The greatest w anywhere in it that feed and overrides ask for, and that the axes allow.
    double cap(const Overrides& overrides) const;
    /// The greatest w anywhere in it that the axes allow, with a share of their greatest speeds.
    double limit(double speed_share = 1) const;

private:
    template <typename Visit>
    void each_axis(Visit visit) const;

    const PathSetup& setup_;
    const JoinedPiece& piece_;
    const Interval& interval_;
};

}  // namespace lockstep
