// A short part of a piece of geometry, in which the square of the speed is linear in the distance.
//
// With t the slope of an axis at the interval's middle, c its bend, d the interval's length and w = (du/dt)^2 at its
// ends, the axis's acceleration changes steadily along the interval, from
//
//     (w1 (t - c d / 2) - w0 (t - 5 c d / 2)) / 2d    to    (w1 (t + 5 c d / 2) - w0 (t + c d / 2)) / 2d.
//
// Both must be within -a to a. These bounds on (w0, w1) are linear and hold at (0, 0): if w1 can follow w0, then every
// share of w1 can follow the same share of w0. So these two passes are exact: a backward pass finds the greatest w of
// each node from which rest can be reached, and a forward pass is as fast as those allow. H. Pham, Q.-C. Pham, "A New
// Approach to Time-Optimal Path Parameterization Based on Reachability Analysis", IEEE T-RO 34 (2018).
//
// On a straight piece the limits are the same everywhere. It is one interval that accelerates, cruises and brakes.
#pragma once

#include <optional>

#include "core/overrides.hpp"
#include "core/path/geometry/quadratic.hpp"
#include "core/path/path_setup.hpp"

namespace lockstep {

/// A piece with the cost of its joints.
struct JoinedPiece {
    Quadratic shape;
    bool is_charged = false;  // jumps at its ends count as curvature: `charged` is used in place of bend
    BendVector charged;
    RowSet rows = RowSet::first(kMaxAxes);  // all that move in it, or in the pieces beside it
    double begin_cap = kNoCap;  // w at its joints if they are slowed instead, so that the piece recovers their jumps
    double end_cap = kNoCap;

    static constexpr double kNoCap = 0x1p100;
};

/// The speed changes steadily from end to end (Curved), or rises, is constant and falls (Straight).
enum class IntervalKind : std::uint8_t { Straight, Curved, Rest };

struct Interval {
    IntervalKind kind = IntervalKind::Curved;
    std::size_t piece = 0;  // the number of its piece in the window
    double from = 0;        // u, mm
    double to = 0;
    double cap = 0;           // greatest w at its beginning by limits and joint, mm^2 per tick^2
    double top = 0;           // greatest w anywhere in it
    double acceleration = 0;  // mm per tick^2; Straight only
    double deceleration = 0;
    double jump = 0;         // greatest jump of an axis at its beginning over its start velocity, per mm per tick
    double joint = 0;        // greatest w that the jump at its beginning allows
    double reach = 0;        // greatest w at its beginning from which all later limits can be kept
    bool may_cruise = true;  // each constant speed up to the top keeps the limits

    double length() const { return to - from; }
};

/// The bounds that one interval sets to the squares of speed at its ends. The data of a piece are collected once for
/// all intervals of it that follow each other.
class IntervalBounds {
public:
    IntervalBounds(const PathSetup& setup, const JoinedPiece& piece, const Interval& interval) : setup_(setup) {
        take(piece, interval);
    }
    /// Goes to another interval. A piece must not change while its intervals are taken.
    void take(const JoinedPiece& piece, const Interval& interval) {
        interval_ = &interval;
        is_collected_ = is_collected_ && &piece == piece_;
        piece_ = &piece;
    }

    /// The greatest w at the beginning that can be followed by `w1` at the end.
    double before(double w1) const;
    /// The greatest w at the end that can follow `w0`.
    double after(double w0) const;
    /// The least w at the end that can follow `w0`; below 0 if the path can come to rest within the interval.
    double least_after(double w0) const;
    /// The greatest w anywhere in it that feed, overrides and axes allow.
    double cap(const Overrides& overrides) const;
    /// The same for each part of it, if it is not the speed of an axis that limits it; otherwise nullopt.
    std::optional<double> common_cap(const Overrides& overrides) const;
    /// The greatest w anywhere in it that the axes allow.
    double limit() const;

private:
    /// A row that moves along the piece.
    struct Row {
        double slope;
        double bend;
        double charged;
        double twice_weaker;  // steps per tick^2
        double max_velocity;
    };
    void collect() const;
    double bend_limit() const;
    double cap_but_speeds(const Overrides& overrides) const;
    double speed_share(const Overrides& overrides) const;
    double speed_limit(double share) const;
    template <typename Visit>
    void each_bound(Visit visit) const;

    const PathSetup& setup_;
    const JoinedPiece* piece_ = nullptr;
    const Interval* interval_ = nullptr;
    // Mutable because they are collected when they are first needed.
    mutable bool is_collected_ = false;
    mutable StaticVector<Row, kMaxAxes> rows_;
    mutable std::optional<double> bend_limit_;
};

}  // namespace lockstep
