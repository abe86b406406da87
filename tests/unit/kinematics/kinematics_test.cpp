#include "core/kinematics/kinematics.hpp"

#include <gtest/gtest.h>

#include <random>

namespace lockstep {
namespace {

AxisConfig axis(const std::string& name, double steps_per_mm) {
    AxisConfig axis;
    axis.name = name;
    axis.steps_per_mm = steps_per_mm;
    axis.position_max_mm = 200;
    return axis;
}

/// Y is moved by motors with 80, 100 and 32 steps per mm.
MachineConfig three_motors() {
    MachineConfig machine;
    machine.axes = {axis("Y", 16 * 100)};
    for (const double steps : {80.0, 100.0, 32.0}) {
        machine.axes[0].motors.push_back({.name = "Y" + std::to_string(steps), .steps_per_mm = steps});
    }
    return machine;
}

MachineConfig two_belts() {
    MachineConfig machine;
    machine.axes = {axis("X", 16 * 80), axis("Y", 16 * 80)};
    machine.axes[0].motors = {{.name = "A", .steps_per_mm = 80}};
    machine.axes[1].motors = {{.name = "B", .steps_per_mm = 80}};
    machine.kinematics.core_xy = {.first = "X", .second = "Y"};
    return machine;
}

MotorCounts counts_of(std::initializer_list<std::int64_t> counts) {
    MotorCounts motors;
    for (const std::int64_t count : counts) { motors.steps.append(count); }
    return motors;
}

/// A path begins where all motors are, so a machine at rest needs one place that rounds to all of them.
TEST(PlaceOfTheAxes, RoundsToTheMotorsAtEveryRest) {
    const Kinematics kinematics(three_motors());
    for (std::int64_t place = -3000; place < 3000; ++place) {
        AxisCounts axes;
        axes.append(place);
        const MotorCounts motors = kinematics.motors_at(axes);
        EXPECT_EQ(kinematics.motors_at(kinematics.axes_at(motors)), motors) << place;
        EXPECT_FALSE(kinematics.astray(motors)) << place;
        EXPECT_LE(std::abs(kinematics.axes_at(motors)[0] - place), kinematics.rest_steps(AxisIndex{0})) << place;
    }
}

/// A park in mm may be just between two steps of one motor, and its axis's nearest place on the other side.
TEST(MotorsWithDifferentSteps, ParkWhereAPlaceOfTheirAxisPutsThem) {
    for (int n = 0; n < 20'000; ++n) {
        MachineConfig machine = three_motors();
        machine.axes[0].motors[0].steps_per_mm = 71.3;
        machine.axes[0].homing.park_mm = n * 0.0077;
        const Kinematics kinematics(machine);
        MotorCounts parked;
        for (const MotorConfig& motor : kinematics.motors()) {
            parked.steps.append(to_steps(motor, motor.homing.park_mm));
        }
        EXPECT_FALSE(kinematics.astray(parked)) << machine.axes[0].homing.park_mm;
    }
}

TEST(PlaceOfTheAxes, RoundsToAnyPlaceOfTwoBelts) {
    const Kinematics kinematics(two_belts());
    std::mt19937 random(1);
    std::uniform_int_distribution<std::int64_t> anywhere(-100'000, 100'000);
    for (int n = 0; n < 1000; ++n) {
        const MotorCounts motors = counts_of({anywhere(random), anywhere(random)});
        EXPECT_EQ(kinematics.motors_at(kinematics.axes_at(motors)), motors);
    }
}

TEST(Motors, AreAstrayByASingleStep) {
    MachineConfig machine;
    machine.axes = {axis("Y", 80)};
    machine.axes[0].motors = {{.name = "Y1", .steps_per_mm = 80}, {.name = "Y2", .steps_per_mm = 80}};
    const Kinematics kinematics(machine);
    EXPECT_FALSE(kinematics.astray(counts_of({400, 400})));
    EXPECT_TRUE(kinematics.astray(counts_of({400, 401})));
}

TEST(PlaceOfTheAxes, IsExactIfItsMotorsHaveItsSteps) {
    MachineConfig machine;
    machine.axes = {axis("X", 80), axis("Y", 80), axis("Z", 80)};
    machine.axes[1].motors = {{.name = "Y1", .steps_per_mm = 80}, {.name = "Y2", .steps_per_mm = 80}};
    machine.kinematics.matrix = {{.motor = "Z", .of = {{"Z", -1}}}};
    const Kinematics kinematics(machine);
    for (std::size_t i = 0; i < 3; ++i) { EXPECT_EQ(kinematics.rest_steps(AxisIndex{i}), 0); }
}

}  // namespace
}  // namespace lockstep
