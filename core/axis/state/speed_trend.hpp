// Decides whether the pulses come faster, slower or steadily. The moving states of an axis follow it.
#pragma once

#include <cmath>
#include <utility>

#include "core/axis/state/fsm.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

class SpeedTrend {
public:
    /// Call it in each loop of a run. Returns SpeedRises when motion begins, however slow it is, and MotionEnds at
    /// rest.
    AxisEvent take(Velocity velocity) {
        constexpr double kSteady = 0x1p-40;  // steps per tick: the effect of rounding on a constant speed, also on 0
        const double speed = std::abs(velocity.steps_per_tick());
        const double last = std::exchange(last_, speed);
        if (speed <= kSteady) { return AxisEvent::MotionEnds; }
        if (last > kSteady && std::abs(speed - last) <= kSteady) { return AxisEvent::SpeedSteady; }
        return speed > last ? AxisEvent::SpeedRises : AxisEvent::SpeedFalls;
    }
    /// The run has ended.
    void rest() { last_ = 0; }

private:
    double last_ = 0;  // steps per tick
};

}  // namespace lockstep
