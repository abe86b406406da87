// Sudden changes of speed that follow each other closely add up. Over every interval of time the limit is
//
//     change of speed  <=  start_velocity + acceleration * time.
#pragma once

#include <algorithm>

namespace lockstep {

/// The change of an axis's speed beyond the change that its acceleration accounts for: the maximum over all intervals
/// that end now. The limit is the start velocity. In steps per tick, one sum for each direction.
struct Strain {
    double up = 0;
    double down = 0;

    /// Adds a signed `change` of speed within `ticks`; `acceleration` (steps per tick^2) accounts for a part of it.
    constexpr void add(double change, double ticks, double acceleration) {
        up = std::max(0.0, up + change - acceleration * ticks);
        down = std::max(0.0, down - change - acceleration * ticks);
    }
    constexpr double most() const { return std::max(up, down); }
};

}  // namespace lockstep
