// Cuts arcs, helices and spirals into quadratic pieces.
//
// A quadratic through the ends and the middle of an arc deviates from it by 0.008 r angle^3. In a spiral whose radius
// changes by c per rad, r is at most the greater radius and 3 c. Angles are halved until that is within the tolerance.
// This needs only sums, products, quotients and roots, so the pieces are the same on every machine.
#pragma once

#include "core/path/geometry/arc_curve.hpp"
#include "core/path/geometry/arc_sweep.hpp"
#include "core/path/geometry/path_trail.hpp"
#include "core/path/geometry/primitive.hpp"

namespace lockstep {

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
    bool is_done() const { return sweep_.is_done(); }
    /// Adds the pieces of the next quarter turn, or of the rest of the arc, each with a mark. `setup` is that of
    /// begin().
    void cut_on(const PathSetup& setup, PathTrail& out);

    const ArcShape& shape() const { return curve_.shape(); }
    /// The move, and the length of the pieces added so far, in mm.
    std::uint32_t block() const { return block_; }
    double along() const { return along_; }

    /// Whole turns that are not cut yet.
    int turns_left() const { return sweep_.turns_left(); }
    /// From here on each whole turn has the same pieces as the one before it, shifted by a distance that is 0 for the
    /// plane's axes.
    bool repeats() const { return curve_.repeats(); }
    /// Leaves out `turns` whole turns: the next piece begins behind them. Their length does not count for along().
    void skip(const PathSetup& setup, int turns);

private:
    void halve(const PathSetup& setup, const ArcPart& part, PathTrail& out);
    double distance(const PathSetup& setup, const PlaceVector& a, const PlaceVector& b) const;
    void add_piece(const PathSetup& setup, const PlaceVector& middle, const PlaceVector& end, PathTrail& out);

    ArcCurve curve_;
    ArcSweep sweep_;
    PlaceVector at_;  // where the next piece begins
    MoveSettings settings_;
    std::uint32_t block_ = 0;
    double along_ = 0;  // mm of the arc before the next piece
};

/// Adds all pieces of an arc to `out`. Returns false and adds nothing if ArcCutter::begin() does.
bool cut_arc(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
             std::uint32_t block, PathTrail& out);

}  // namespace lockstep
