// Sudden changes of speed add up where they follow each other closely: over every stretch of time
//
//     change of speed  <=  start_velocity + acceleration * time.
#pragma once

#include <algorithm>

namespace lockstep {

/// By how much an axis's speed has changed beyond what its acceleration accounts for, over the stretch up to now for
/// which that is the most: at most the start velocity. Speeds in steps per tick, signed; one sum for either way.
struct Strain {
    double up = 0;
    double down = 0;

    /// Within `ticks` the speed changed by `change`; `acceleration` (steps per tick^2) accounts for so much a tick.
    constexpr void add(double change, double ticks, double acceleration) {
        up = std::max(0.0, up + change - acceleration * ticks);
        down = std::max(0.0, down - change - acceleration * ticks);
    }
    constexpr double most() const { return std::max(up, down); }
};

}  // namespace lockstep
