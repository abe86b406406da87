// Orders of a homing by frames: the axis is assumed to be at a place, and at last it takes its place as true.
#pragma once

#include "core/axis/state/axis_loop.hpp"

namespace lockstep {

/// Begins a homing by frames, or goes on with it. `rests`: the axis follows nothing.
void assume_place(const AxisCommand& order, bool rests, AxisLoop& loop);
/// The axis is homed.
void take_place(const AxisCommand& order, bool rests, AxisLoop& loop);

}  // namespace lockstep
