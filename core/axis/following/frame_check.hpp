// The axis does not trust the coordinator. It checks every frame against its own limits before it holds the frame.
#pragma once

#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/motion/piece_check.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// Checks a frame's track for one axis that continues from `from`:
/// - its start is bit-exactly `from.position` (FrameDiscontinuous);
/// - speed, acceleration, deceleration and sudden changes keep the limits, also several changes in close succession,
///   and the tail, or the body of a last frame, ends no faster than the start velocity (FrameBeyondLimits). A change by
///   one tick's acceleration is tolerated where pieces meet, because pieces last whole ticks;
/// - body and tail stay within the travel (FrameOutsideTravel);
/// - the body lasts exactly `ticks`, no piece is empty (BadProgram).
/// Returns None and moves `from` to the body's end, or returns the first violation and leaves `from` unchanged.
FaultCode check_track(const AxisTrack& track, Ticks ticks, bool last, const AxisLimits& limits, MotionPoint& from);

}  // namespace lockstep
