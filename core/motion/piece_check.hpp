// The limits of one axis, checked on the pieces that its engine executes. The planner and the axis use the same check.
#pragma once

#include <span>

#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/motion/strain.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

/// The state of a trajectory at an instant, passed from piece to piece.
struct MotionPoint {
    Position position;
    double velocity = 0;  // steps per tick, of the continuous motion
    Strain strain;        // the sum of sudden changes of speed
};

/// Follows `pieces` from `point` and moves it to their end. Returns None, or the first breach:
/// - speed, acceleration, deceleration or sudden changes beyond the limits (FrameBeyondLimits). An excess of one tick's
///   acceleration is tolerated where pieces meet, since pieces last whole ticks;
/// - a piece that ends outside the travel (FrameOutsideTravel);
/// - a piece without ticks, or with more than exact arithmetic can count (BadProgram).
FaultCode check_pieces(std::span<const Piece> pieces, const AxisLimits& limits, MotionPoint& point);

/// Whether the axis may rest at `end` without a jump beyond its start velocity.
bool may_rest(const MotionPoint& end, const AxisLimits& limits);

}  // namespace lockstep
