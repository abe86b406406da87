// How far and how fast each axis goes along a path at its planned speed.
//
// The figures are those of the path itself. The pieces of frames follow it within kFitShare of a step, in whole ticks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/path/speed_window.hpp"

namespace lockstep {

/// The load of one axis, in steps and ticks.
struct AxisLoad {
    std::int64_t steps = 0;  // in both directions together
    std::int64_t least = 0;  // the range of its positions
    std::int64_t greatest = 0;
    double peak_velocity = 0;
    double peak_acceleration = 0;  // rising or falling
    double peak_jump = 0;          // largest sudden change of its speed: in a corner, at the start or at the stop
};

/// The passage of an interval.
struct PassedInterval {
    const JoinedPiece& piece;
    const Interval& part;
    double v0 = 0;  // speeds along the path at its ends, mm per tick
    double v1 = 0;
    double top = 0;  // the greatest speed in it
};

class PathLoad {
public:
    explicit PathLoad(std::span<const std::int64_t> at);

    /// The axes rest at the place where the next piece begins.
    void begin();
    /// Call it for each interval, in order. `is_first`: it is the first interval of its piece.
    void pass(const PassedInterval& passed, bool is_first);
    /// The path ends at rest; `v` is the speed along it before the last jump.
    void end(double v);
    /// Adds steps of turns that are not passed.
    void add_steps(RowIndex row, std::int64_t steps) { axes_[row].steps += steps; }

    const std::vector<AxisLoad>& axes() const { return axes_; }

private:
    void note_place(RowIndex row, double place);
    void note_piece(const Quadratic& shape);
    void note_joint(const JoinedPiece& next, double v);
    void note_jump(RowIndex row, double slope, double v);
    void note_straight(const PassedInterval& passed);
    void note_curved(const PassedInterval& passed);

    std::vector<AxisLoad> axes_;
    std::vector<std::int64_t> counts_;  // where the last piece ends
    std::vector<double> slopes_;        // there, steps per mm; 0 at rest
};

}  // namespace lockstep
