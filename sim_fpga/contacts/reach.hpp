// How far an axis can go in the next interval of motion, so that contacts are only looked at closely where they may
// change.
#pragma once

#include "core/machine.hpp"

namespace lockstep {

/// The limits of an axis, or of a way of several, in mm and ticks.
struct Reach {
    double most = 0;   // speed
    double start = 0;  // speed that is reached at once
    double accel = 0;

    static Reach of(const AxisConfig& axis, const MachineConfig& machine);
    /// Of the way of both.
    Reach with(const Reach& other) const;

    /// mm within `next` ticks, at most, after a way of `way_mm` in the last `last` ticks. Where a path turns an axis
    /// may gain speed at once: up to three times its last one is allowed for.
    double mm(double way_mm, Ticks last, Ticks next) const;
};

}  // namespace lockstep
