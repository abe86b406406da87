// Cuts arcs, helices and spirals into quadratic pieces.
//
// A quadratic through the ends and the middle of an arc deviates from it by 0.008 r angle^3. In a spiral whose radius
// changes by c per rad, r is at most the greater radius and 3 c. Angles are halved until that is within the tolerance.
// This needs only sums, products, quotients and roots, so the pieces are the same on every machine.
#pragma once

#include "core/path/geometry/path_trail.hpp"
#include "core/path/geometry/primitive.hpp"
#include "core/path/path_setup.hpp"

namespace lockstep {

/// The two begins and the end of an arc, in steps.
struct ArcEnds {
    AxisVector at;    // where the axes are: on whole steps after a rest
    AxisVector from;  // the programmed begin of the arc
    AxisVector to;
};

/// Cuts one arc, a quarter turn at a time, so that an arc of many turns takes no more memory than a short one.
class ArcCutter {
public:
    /// A cutter with nothing to cut.
    ArcCutter() = default;
    /// Returns false and has nothing to cut if the arc's radii are a quarter of a step or less; then a straight line is
    /// good enough.
    bool begin(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
               std::uint32_t block);

    /// All pieces have been added.
    bool is_done() const { return next_ == all_ && !has_part_; }
    /// Adds the pieces of the next quarter turn, or of the rest of the arc, each with a mark. `setup` is that of
    /// begin().
    void cut_on(const PathSetup& setup, PathTrail& out);

    const ArcShape& shape() const { return arc_; }
    /// The move, and the length of the pieces added so far, in mm.
    std::uint32_t block() const { return block_; }
    double along() const { return along_; }

    /// Whole turns that are not cut yet.
    int turns_left() const { return (all_ - next_) / 4; }
    /// From here on each whole turn has the same pieces as the one before it, shifted by a distance that is 0 for the
    /// plane's axes.
    bool repeats(const PathSetup& setup) const;
    /// Leaves out `turns` whole turns: the next piece begins behind them. Their length does not count for along().
    void skip(const PathSetup& setup, int turns);

private:
    /// A unit vector in the plane of the arc. Clockwise arcs are mirrored, so that all arcs turn the same way.
    struct Direction {
        double x = 0;
        double y = 0;
        Direction quarter_on() const { return {-y, x}; }
        double dot(Direction o) const { return x * o.x + y * o.y; }
        double cross(Direction o) const { return x * o.y - y * o.x; }
    };
    struct Part;

    static Direction unit(double x, double y);
    static Direction between(Direction a, Direction b) { return unit(a.x + b.x, a.y + b.y); }
    static double angle_between(Direction a, Direction b);
    static Direction turned(Direction a, int quarters);
    static int quarters_between(Direction a, Direction b);
    void find_moving();
    double scale(const PathSetup& setup) const;
    Direction direction(const PathSetup& setup, const AxisVector& at, double& radius_mm) const;
    double tolerance(double before, double share) const;
    AxisVector place(const PathSetup& setup, Direction d, double done) const;
    double distance(const PathSetup& setup, const AxisVector& a, const AxisVector& b) const;
    void halve(const PathSetup& setup, const Part& part, PathTrail& out);
    void add_piece(const PathSetup& setup, const AxisVector& middle, const AxisVector& end, PathTrail& out);

    ArcShape arc_;
    AxisVector from_;
    AxisVector to_;
    AxisVector at_;  // where the next piece begins
    Quadratic pattern_;
    std::uint32_t block_ = 0;
    Direction begin_;
    Direction end_;
    int all_ = 0;              // whole quarter turns
    int next_ = 0;             // the next of them
    int quarters_ = 0;         // of the last turn
    double part_ = 0;          // rad, behind the whole quarter turns
    bool has_part_ = false;    // the part behind the whole quarter turns is not cut yet
    bool ends_whole_ = false;  // the arc ends with a whole quarter turn
    double radius_begin_ = 0;  // mm
    double radius_end_ = 0;    // mm
    double sweep_ = 0;         // rad, of the whole arc
    double bent_ = 0;          // mm, for the deviation of its pieces
    AxisSet moving_ = 0;       // the axes that move
    AxisVector off_;           // the place of the axes at the begin minus the programmed begin
    bool is_off_ = false;
    double along_ = 0;  // mm of the arc before the next piece
};

/// Adds all pieces of an arc to `out`. Returns false and adds nothing if ArcCutter::begin() does.
bool cut_arc(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
             std::uint32_t block, PathTrail& out);

}  // namespace lockstep
