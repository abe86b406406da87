// Joins the chords of a polyline into quadratic pieces, as long as the tolerance allows: an arc or a line then costs
// the same however finely it was cut.
//
// - A corner is a vertex where the directions over kLook_mm on either side differ by more than 0.35 rad, and by more
//   than at the vertices beside it. Corners are kept exactly, and pieces end there.
// - Elsewhere chords are taken for a curve's. A piece ends beside its vertex, inside the bend by min(l0, l1)/16 (t1 -
// t0)
//   with the lengths and slopes of the chords on either side: half the distance from the curve to the chord, so that
//   the curve is within half of it from the polyline on both sides.
// - Each piece is the longest that ChordFit accepts, of at most kMaxChords and kMaxLength_mm.
//
// The pieces depend on the points only, not on when they arrived: a choice is made when all that it depends on is
// known.
#pragma once

#include <vector>

#include "core/path/chord_fit.hpp"
#include "core/path/path_setup.hpp"
#include "core/path/path_trail.hpp"

namespace lockstep {

class ChordJoiner {
public:
    explicit ChordJoiner(const PathSetup& setup) : setup_(setup) {}

    /// A polyline begins at a place in steps. The one before has been finished.
    void begin(const AxisVector& at);
    /// A chord to a place. Chords of less than kLeast_mm are left out until they add up. Pieces are added to `out`,
    /// with a mark where each chord begins.
    void add(const AxisVector& to, const MoveSettings& settings, std::uint32_t block, PathTrail& out);
    /// The polyline ends: the remaining pieces. `end`, in steps, takes the place of its last point; the last chord is a
    /// piece of its own then, so that its tolerance and what the end was moved by do not add up.
    void finish(const AxisVector& end, PathTrail& out);
    /// Where the last chord ends, in steps.
    const AxisVector& at() const { return end_; }

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

    void measure_turns(bool is_end);
    void find_corners(bool is_end);
    double turn_at(std::size_t k) const;
    bool is_corner(std::size_t k) const;
    Reach reach(bool is_end);
    void join(bool is_end, PathTrail& out);
    void mark(std::size_t chords, PathTrail& out) const;
    std::size_t longest(const Reach& reach, Quadratic& best);
    bool try_chords(std::size_t chords, Quadratic& best);
    bool is_within_travel(const Quadratic& piece) const;
    AxisVector end_at(std::size_t k) const;
    void set_tolerance(const MoveSettings& settings);
    void drop_passed();

    PathSetup setup_;
    SlidingVector<PathPoint> points_;
    ChordFit fit_;
    AxisVector end_;
    std::vector<double> tolerance_steps_;  // of the piece that is being looked for
    std::size_t start_ = 0;                // the vertex at which the next piece begins
    AxisVector start_at_;                  // and its place
    bool is_fit_begun_ = false;            // for start_
    std::size_t measured_ = 1;             // the first vertex whose turn was not measured yet
    std::size_t found_ = 1;                // the first vertex that was not classified yet: corner or not
    std::size_t behind_ = 0;               // turn_at: the last vertex that is kLook_mm or more behind
    std::size_t ahead_ = 0;
    std::size_t scanned_ = 0;  // reach: no end of a piece is between start_ and it
    std::size_t guess_ = 1;    // chords: the length of the last piece
    std::size_t needed_ = 0;   // chords that must be known before it is worth trying again
};

}  // namespace lockstep
