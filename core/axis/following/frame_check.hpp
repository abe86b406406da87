// The axis does not trust the coordinator: every frame is held against the axis's own limits before it is held.
#pragma once

#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/motion/piece_check.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// Checks a frame's track for one axis that follows on from `from`:
/// - its start is bit-exactly `from.position` (FrameDiscontinuous);
/// - speed, acceleration, deceleration and sudden changes keep the limits, also those that follow each other closely,
///   and the tail, or the body of a last frame, ends no faster than the start velocity (FrameBeyondLimits). What one
///   tick's acceleration can do is tolerated where pieces meet, since pieces last whole ticks;
/// - body and tail stay within the travel (FrameOutsideTravel);
/// - the body lasts exactly `ticks`, no piece is empty (BadProgram).
/// Returns None and moves `from` to the body's end, or says the first thing wrong and leaves `from`.
FaultCode check_track(const AxisTrack& track, Ticks ticks, bool last, const AxisLimits& limits, MotionPoint& from);

}  // namespace lockstep
