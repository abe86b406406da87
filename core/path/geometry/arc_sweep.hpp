// The angle of an arc, as whole quarter turns and a part behind them, and how much of it is left to be cut.
#pragma once

#include "core/path/geometry/arc_direction.hpp"

namespace lockstep {

/// A part of an arc from direction a to b, `angle` (rad) long and `done` behind the arc's begin.
struct ArcPart {
    ArcDirection a;
    ArcDirection b;
    double done = 0;
    double angle = 0;
    bool is_last = false;
};

class ArcSweep {
public:
    /// Nothing is left.
    ArcSweep() = default;
    /// Ends in the same direction make a whole turn.
    ArcSweep(ArcDirection begin, ArcDirection end, int turns);

    /// The whole angle, rad.
    double angle() const { return angle_; }
    bool is_done() const { return next_ == all_ && !has_part_; }
    /// Takes the next quarter turn, or the rest of the arc.
    ArcPart take();
    /// Whole turns that are left.
    int turns_left() const { return (all_ - next_) / 4; }
    /// Leaves out whole turns. Returns the place behind them, as a part without an angle.
    ArcPart skip(int turns);

private:
    static constexpr double kQuarter = 1.5707963267948966;

    ArcDirection begin_;
    ArcDirection end_;
    int all_ = 0;              // whole quarter turns
    int next_ = 0;             // the next of them
    double part_ = 0;          // rad, behind the whole quarter turns
    bool has_part_ = false;    // the part behind the whole quarter turns is left
    bool ends_whole_ = false;  // the arc ends with a whole quarter turn
    double angle_ = 0;
};

}  // namespace lockstep
