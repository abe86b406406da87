#include "core/coordinator/homing/assumed_place.hpp"

#include <algorithm>
#include <cstdlib>

namespace lockstep {
namespace {

/// Axes that are beyond their travel only because their motors rest on whole steps are placed at its end: no path could
/// begin there.
AxisCounts near_travel(AxisCounts at, const LoopView& loop) {
    constexpr std::int64_t kRoundings =
        4;  // of an axis, of its assumed place, of its true place, and of the other axis
    for (const AxisIndex i : axis_indices(at.size())) {
        const AxisConfig& axis = loop.machine.axes[i];
        const std::int64_t inside =
            std::clamp(at[i], to_steps(axis, axis.position_min_mm), to_steps(axis, axis.position_max_mm));
        if (std::abs(at[i] - inside) <= kRoundings * loop.kinematics.rest_steps(i)) { at[i] = inside; }
    }
    return at;
}

}  // namespace

AssumedPlace::AssumedPlace(AxisIndex axis, const LoopView& loop) : axis_(axis), began_(loop.counts()) {
    for (std::size_t m = 0; m < loop.axes.size(); ++m) { given_.append(0); }
}

MotorCounts AssumedPlace::for_move(std::int64_t place, const LoopView& loop) {
    const AxisCounts here = near_travel(loop.counts(), loop);
    moved_ += place - loop.counts()[axis_];
    MotorCounts motors = loop.axes.counts();
    for (const MotorIndex m : loop.kinematics.motors_of_axes({axis_})) {
        const std::int64_t assumed = loop.kinematics.motor_at(m, here, axis_, place);
        given_[m] += assumed - motors[m];
        motors.steps[m] = assumed;
    }
    return motors;
}

MotorCounts AssumedPlace::truth(std::int64_t place, const LoopView& loop) {
    const MotorSet own = loop.kinematics.motors_of_axes({axis_});
    moved_ += place - loop.counts()[axis_];
    MotorCounts motors = loop.axes.counts();
    for (const MotorIndex m : own) {
        const std::int64_t shift = loop.kinematics.motor_at(m, began_, axis_, began_[axis_] + moved_) -
                                   loop.kinematics.motor_at(m, began_, axis_, began_[axis_]);
        motors.steps[m] += shift - given_[m];
    }
    const AxisCounts axes = loop.kinematics.axes_at(motors);
    const AxisCounts inside = near_travel(axes, loop);
    if (inside == axes) { return motors; }
    const MotorCounts there = loop.kinematics.motors_at(inside);
    for (const MotorIndex m : own) { motors.steps[m] = there[m]; }
    return motors;
}

}  // namespace lockstep
