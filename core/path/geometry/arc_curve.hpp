// Places on an arc, helix or spiral, and how far a quadratic piece is from it.
#pragma once

#include "core/path/geometry/arc_direction.hpp"
#include "core/path/path_setup.hpp"
#include "core/program.hpp"

namespace lockstep {

/// The two begins and the end of an arc, in steps.
struct ArcEnds {
    PlaceVector at;    // where the axes are: on whole steps after a rest
    PlaceVector from;  // the programmed begin of the arc
    PlaceVector to;
};

/// An end of an arc as seen from its centre.
struct ArcSpoke {
    ArcDirection direction;
    double radius_mm = 0;
};
ArcSpoke arc_spoke(const PathSetup& setup, const ArcShape& shape, const PlaceVector& at);

/// The most steps of a motor per mm of the arc's plane.
double steps_per_mm_of_plane(const PathSetup& setup, const ArcShape& shape);

class ArcCurve {
public:
    ArcCurve() = default;
    /// `sweep`: the angle of the whole arc, rad.
    ArcCurve(const PathSetup& setup, const ArcShape& shape, const ArcEnds& ends, double radius_begin_mm,
             double radius_end_mm, double sweep);

    const ArcShape& shape() const { return shape_; }
    /// The axes that move along the arc.
    AxisSet moving() const { return moving_; }
    /// Sets the places of the moving axes, in the direction d from the centre and `done` rad behind the arc's begin.
    void place(const PathSetup& setup, ArcDirection d, double done, PlaceVector& at) const;
    const PlaceVector& end() const { return to_; }
    /// Each whole turn is like the one before it, shifted by a distance that is 0 for the plane's axes.
    bool repeats() const;
    /// Whether one piece is close enough to a part, `done` rad behind the arc's begin and `angle` long.
    bool is_near(double done, double angle) const;

private:
    double tolerance(double before, double share) const;

    ArcShape shape_;
    PlaceVector from_;
    PlaceVector to_;
    PlaceVector off_;  // the place of the axes at the begin minus the programmed begin
    bool is_off_ = false;
    AxisSet moving_;
    double radius_begin_ = 0;  // mm
    double radius_end_ = 0;    // mm
    double sweep_ = 0;         // rad
    double scale_ = 0;         // steps_per_mm_of_plane
    double error_ = 0;         // steps, of a piece of 1 rad
};

}  // namespace lockstep
