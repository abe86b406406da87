// A motor driven within its abilities loses no steps; driven far beyond them, it does.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/kinematics/motors.hpp"
#include "tests/unit/sim_fpga/drive.hpp"

namespace lockstep {
namespace {

double number_in(int low, int high) { return *rc::gen::inRange(low, high); }

struct Motor {
    MotorConfig axis;
    double jump;
    double accel;
    double fastest;  // a step per 3 ticks, or so
};

Motor any_motor() {
    Motor motor;
    motor.axis.steps_per_mm = number_in(5, 1000);
    motor.jump = number_in(1, 100);
    motor.accel = number_in(10, 20'000);
    motor.axis.plant = {.max_torque_accel_mm_s2 = motor.accel, .max_jump_mm_s = motor.jump};
    motor.fastest = std::min(1000.0, 0.3e6 / motor.axis.steps_per_mm);
    return motor;
}

RC_GTEST_PROP(Motor, AnyProfileWithinItsTorqueAndJumpLosesNothing, ()) {
    const Motor motor = any_motor();
    const double jump = motor.jump * number_in(0, 101) / 100;
    const double speed = jump + (motor.fastest - jump) * number_in(0, 101) / 100;
    const double accel = motor.accel * number_in(10, 101) / 100;
    std::vector<Ramp> ramps = trapezoid(jump, speed, accel, number_in(1, 200) / 1000);
    if (*rc::gen::arbitrary<bool>()) {
        for (Ramp& ramp : ramps) { ramp = {-ramp.from_mm_s, -ramp.to_mm_s, ramp.seconds}; }
    }
    RC_ASSERT(steps_lost(motor.axis, ramps) == 0);
}

RC_GTEST_PROP(Motor, AnyJumpFarBeyondLosesSteps, ()) {
    const Motor motor = any_motor();
    const double one_step = std::sqrt(2 * motor.accel / motor.axis.steps_per_mm);  // gained in a step, mm/s
    const double jump = 2 * (motor.jump + one_step) * number_in(1, 5);
    RC_PRE(jump < motor.fastest);
    RC_ASSERT(steps_lost(motor.axis, {{jump, jump, 0.1 + 10 / (jump * motor.axis.steps_per_mm)}}) > 0);
}

RC_GTEST_PROP(Motor, AnyAccelerationFarBeyondLosesSteps, ()) {
    const Motor motor = any_motor();
    const double one_step = std::sqrt(2 * motor.accel / motor.axis.steps_per_mm);
    const double speed = 8 * (motor.jump + one_step);
    RC_PRE(speed < motor.fastest / 2);
    RC_ASSERT(steps_lost(motor.axis, trapezoid(0, speed, 2 * motor.accel, 0.05)) > 0);
}

}  // namespace
}  // namespace lockstep
