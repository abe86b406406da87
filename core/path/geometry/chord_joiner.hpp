// Joins the chords of a polyline into quadratic pieces that are as long as the tolerance allows. So the cost of an arc
// or a line does not depend on how finely it was cut.
//
// - A corner is a vertex where the directions over kLook_mm on either side differ by more than 0.35 rad, and by more
//   than at the vertices within kLook_mm. Corners are kept exactly, and pieces end there.
// - Elsewhere chords are treated as chords of a curve. A piece ends beside its vertex, inside the bend by
//   min(l0, l1)/16 (t1 - t0), with the lengths l and slopes t of the chords on either side. That is half the distance
//   from the curve to the chord, so that the curve is within half of that distance from the polyline on both sides.
// - Each piece is the longest that ChordFit accepts, of at most kMaxChords and kMaxLength_mm.
//
// The pieces depend on the points only, not on when they arrived: the joiner decides only when everything that a
// decision depends on is known.
#pragma once

#include <vector>

#include "core/path/geometry/chord_fit.hpp"
#include "core/path/geometry/path_trail.hpp"
#include "core/path/path_setup.hpp"

namespace lockstep {

class ChordJoiner {
public:
    explicit ChordJoiner(const PathSetup& setup) : setup_(setup) {}

    /// Begins a polyline at a place in steps. The previous one must have been finished.
    void begin(const PlaceVector& at);
    /// Adds a chord to a place. Omits chords of less than kLeast_mm until they add up to that. Adds pieces to `out`,
    /// with a mark where each chord begins.
    void add(const PlaceVector& to, const MoveSettings& settings, std::uint32_t block, PathTrail& out);
    /// Ends the polyline and adds the remaining pieces. `end`, in steps, replaces its last point. The last chord is
    /// then a separate piece, so that the tolerance and the displacement of the end do not add up.
    void finish(const PlaceVector& end, PathTrail& out);
    /// Where the last chord ends, in steps.
    const PlaceVector& at() const { return end_; }

    static constexpr double kLook_mm = 0.04;
    static constexpr double kLeast_mm = 1e-6;
    static constexpr std::size_t kMaxChords = 512;
    static constexpr double kMaxLength_mm = 20;

private:
    /// How far a piece from start_ may reach.
    struct Reach {
        std::size_t chords = 0;
        bool is_decided = false;  // more points would not change it
    };

    void measure_deflections(bool is_end);
    void find_corners(bool is_end);
    double deflection_at(std::size_t k) const;
    bool is_corner(std::size_t k) const;
    Reach reach(bool is_end);
    void join(bool is_end, PathTrail& out);
    void mark(std::size_t chords, PathTrail& out) const;
    std::size_t longest(const Reach& reach, Quadratic& best);
    bool try_chords(std::size_t chords, Quadratic& best);
    bool is_within_travel(const Quadratic& piece) const;
    PlaceVector end_at(std::size_t k) const;
    double step_to(const PlaceVector& from, const PlaceVector& to);
    void set_tolerance(const MoveSettings& settings);
    void drop_passed();

    PathSetup setup_;
    SlidingVector<PathPoint> points_;
    ChordFit fit_;
    PlaceVector end_;
    AxisSet moving_;                       // the axes that do not have the same place at all points
    double tolerance_mm_ = -1;             // of tolerance_steps_
    std::vector<double> tolerance_steps_;  // of the next piece
    std::size_t start_ = 0;                // the vertex at which the next piece begins
    PlaceVector start_at_;                 // and its place
    PlaceVector best_end_;                 // where the best piece that was found ends
    bool is_fit_begun_ = false;            // for start_
    std::size_t measured_ = 1;             // the first vertex whose deflection is not measured yet
    std::size_t found_ = 1;                // the first vertex that is not classified yet: corner or not
    std::size_t behind_ = 0;               // deflection_at: the last vertex that is kLook_mm or more behind
    std::size_t ahead_ = 0;
    std::size_t scanned_ = 0;  // reach: no end of a piece is between start_ and it
    std::size_t guess_ = 1;    // chords: the length of the last piece
    std::size_t needed_ = 0;   // chords that must be known before the next attempt
};

}  // namespace lockstep
