#include "core/coordinator/homing/assumed_place.hpp"

#include <cstdlib>

#include "core/motion/frame_limits.hpp"

namespace lockstep {
namespace {

/// Axes that are beyond their travel only because their motors rest on whole steps are placed at its end: no path could
/// begin there.
AxisCounts near_travel(AxisCounts at, const LoopView& loop) {
    constexpr std::int64_t kRoundings = 2;  // of where the motors rest, and of where they are assumed to be
    const AxisCounts inside = within_travel(at, axis_frame_limits_of(loop.machine));
    for (const AxisIndex i : axis_indices(at.size())) {
        if (std::abs(at[i] - inside[i]) <= kRoundings * loop.kinematics.rest_steps(i)) { at[i] = inside[i]; }
    }
    return at;
}

}  // namespace

AssumedPlace::AssumedPlace(AxisIndex axis, std::size_t motors) : axis_(axis) {
    while (given_.size() < motors) { given_.append(0); }
}

MotorCounts AssumedPlace::for_move(std::int64_t place, const LoopView& loop) {
    const AxisCounts here = near_travel(loop.counts(), loop);
    MotorCounts motors = loop.axes.counts();
    for (const MotorIndex m : loop.kinematics.motors_of_axes({axis_})) {
        const std::int64_t assumed = loop.kinematics.motor_at(m, here, axis_, place);
        given_[m] += assumed - motors[m];
        motors.steps[m] = assumed;
    }
    return motors;
}

MotorCounts AssumedPlace::truth(std::int64_t place, const LoopView& loop) const {
    MotorCounts motors = loop.axes.counts();
    for (std::size_t m = 0; m < given_.size(); ++m) { motors.steps[m] -= given_[m]; }
    AxisCounts at = loop.kinematics.axes_at(motors);
    at[axis_] = place;
    return loop.kinematics.motors_at(near_travel(at, loop));
}

}  // namespace lockstep
