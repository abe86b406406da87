#include "tests/simulation/simtest/record/touch_errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/indices.hpp"
#include "tests/simulation/simtest/draw/draw_bounces.hpp"

namespace lockstep::simtest {

void TouchErrors::note(MotorIndex motor, const AxisState& state) {
    published_[motor] = state.clock_error;
    Moving& moving = moving_[motor];
    if (std::exchange(moving.was_homed, state.homed) && !state.homed) { moving.error = {}; }
    if (!state.homed && !state.at_rest) { moving.error = std::max(moving.error, std::ranges::max(published_)); }
}

/// The clock that tells of the touch is not the one that tells of the steps.
double TouchErrors::steps(MotorIndex motor) const {
    const double clocks_s = 2e-6 * machine_.microseconds(moving_[motor].error);
    double steps = 0;
    for (const AxisIndex i : axis_indices(machine_.axes.size())) {
        const AxisConfig& axis = machine_.axes[i];
        if (axis.homing.way != HomingWay::ByTouch) { continue; }
        const auto input = std::ranges::find(machine_.inputs, axis.homing.input, &InputConfig::name);
        const double way_mm = axis.homing.latch_velocity_mm_s * (clocks_s + bounce_seconds(*input));
        steps += std::abs(shares_.share(motor, i)) * axis.steps_per_mm * way_mm;
    }
    return steps;
}

}  // namespace lockstep::simtest
