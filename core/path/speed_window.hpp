// Look-ahead: the greatest speed at each place of the path, in a window that moves with the motion.
//
// Pieces of geometry are added at the end and cut into intervals, whose speeds IntervalWindow finds. The result does
// not depend on when pieces arrived, bit for bit, and the window is as long as the stopping distance.
#pragma once

#include <algorithm>
#include <optional>

#include "core/path/geometry/backlash_rows.hpp"
#include "core/path/geometry/path_trail.hpp"
#include "core/path/interval_window.hpp"
#include "core/path/piece_joints.hpp"

namespace lockstep {

/// The result of applying new overrides.
enum class OverrideResult : std::uint8_t {
    Taken,
    CannotFollow,  // the axes cannot follow from this place
    LacksPath,     // too little of the path is known to decide
};

class SpeedWindow : public IntervalWindow {
public:
    explicit SpeedWindow(const PathSetup& setup) : IntervalWindow(setup) { restart({}, {}); }
    /// Resets it to a new window. Its memory is kept. The path begins at rest at `begin`, on the first piece that is
    /// added. `motors`: where they rest there, which tells their plays; empty: where the map places them.
    void restart(const Overrides& overrides, const PathSpot& begin, std::span<const Position> motors = {});

    /// Adds a piece that begins where the last one ends, in steps of the axes. A length of 0 is a rest.
    void add(const Quadratic& piece);
    /// Ends the path at rest at the end of the last piece.
    void finish();

    /// Applies new overrides from an interval's beginning; `w` is the squared speed there. Speeds during the hardest
    /// braking from there are allowed. A piece in progress gets faster only if it can still recover the jumps at its
    /// ends. Unless it returns Taken, the window must not be used again.
    OverrideResult set_overrides(const Overrides& overrides, std::size_t number, double w);

private:
    /// Where the path begins on the first piece of the window.
    double begin_of(const Quadratic& piece) const { return std::max(begin_u_ - piece.begin, 0.0); }
    PieceJoints joints() const { return {setup_, overrides_}; }
    Joint joint_at_end(std::size_t k) const;
    Neighbours beside(std::size_t k) const;
    void add_rows(const Quadratic& piece);
    void close_piece(std::size_t k);
    void close_end();
    const Quadratic* shape_at(std::size_t k) const { return k < pieces_.size() ? &pieces_[k].shape : nullptr; }
    bool may_rise(std::size_t piece) const;
    void turn_piece(std::size_t number);
    void recut_behind(std::size_t piece);
    OverrideResult allow_braking(std::size_t number, double w);
    void rise_at_once(std::size_t number, double w);
    bool split_change(std::size_t number, double w);
    double way_to_top(const Interval& part, double w) const;

    BacklashRows backlash_;
    Overrides overrides_;
    double begin_u_ = 0;            // where the path begins on the first piece of geometry
    std::optional<Joint> joint_;    // at the begin of the open piece, if it is known
    ReusedQueue<Quadratic> ahead_;  // recut_behind: the pieces to cut again, the last one first
};

}  // namespace lockstep
