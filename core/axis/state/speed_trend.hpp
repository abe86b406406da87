// Whether the pulses come faster, slower or steadily: what the moving states of an axis follow.
#pragma once

#include <cmath>
#include <utility>

#include "core/axis/state/fsm.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

class SpeedTrend {
public:
    /// Each loop of a run. Out of rest the speed rises, however slow it is; at rest it is MotionEnds.
    AxisEvent take(Velocity velocity) {
        constexpr double kSteady = 0x1p-40;  // steps per tick: what rounding makes of a constant speed, 0 too
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
