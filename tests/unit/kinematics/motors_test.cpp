#include "core/kinematics/motors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace lockstep {
namespace {

AxisConfig axis(const std::string& name) {
    AxisConfig axis;
    axis.name = name;
    axis.steps_per_mm = 80;
    axis.start_velocity_mm_s = 5;
    axis.max_velocity_mm_s = 200;
    axis.max_accel_mm_s2 = 3000;
    axis.max_decel_mm_s2 = 2000;
    axis.position_min_mm = -1;
    axis.position_max_mm = 300;
    axis.device = {DeviceName::Kind::Shared, name};
    axis.homing.switch_position_mm = -1;
    axis.plant.start_position_mm = 40;
    return axis;
}

MotorBlock motor(const std::string& name, std::optional<double> steps_per_mm = std::nullopt) {
    return {.name = name, .host = "", .steps_per_mm = steps_per_mm};
}

TEST(Motors, AreTheAxesOfAMachineWithoutMotorBlocks) {
    MachineConfig machine;
    machine.axes = {axis("X"), axis("Y")};
    machine.axes[1].max_velocity_mm_s = 70.3;
    const std::vector<MotorConfig> motors = motors_of(machine);
    ASSERT_EQ(motors.size(), 2U);
    EXPECT_EQ(motor_count(machine), 2U);
    EXPECT_TRUE(step_map_of(machine).is_identity());
    for (std::size_t i = 0; i < 2; ++i) {
        const AxisConfig& from = machine.axes[i];
        EXPECT_EQ(motors[i].name, from.name);
        EXPECT_EQ(motors[i].device, from.device);
        EXPECT_EQ(motors[i].axis, i);
        EXPECT_TRUE(motors[i].moves_one_axis);
        EXPECT_EQ(motors[i].max_velocity_mm_s, from.max_velocity_mm_s);
        EXPECT_EQ(motors[i].max_decel_mm_s2, from.max_decel_mm_s2);
        EXPECT_EQ(motors[i].position_min_mm, from.position_min_mm);
        EXPECT_EQ(motors[i].plant.start_position_mm, from.plant.start_position_mm);
    }
}

TEST(Motors, OfAGantryHaveTheAxissLimitsOrTheirOwn) {
    MachineConfig machine;
    machine.axes = {axis("X"), axis("Y")};
    machine.axes[1].motors = {motor("Y1"), motor("Y2", 100)};
    machine.axes[1].motors[1].max_velocity_mm_s = 150;
    machine.axes[1].motors[1].switch_offset_mm = 0.4;
    const std::vector<MotorConfig> motors = motors_of(machine);
    EXPECT_EQ(motor_names(machine), (std::vector<std::string>{"X", "Y1", "Y2"}));
    EXPECT_EQ(motors[1].max_velocity_mm_s, 200);
    EXPECT_EQ(motors[2].max_velocity_mm_s, 150);
    EXPECT_EQ(motors[2].start_velocity_mm_s, 5);
    EXPECT_EQ(motors[1].homing.switch_position_mm, -1);
    EXPECT_EQ(motors[2].homing.switch_position_mm, -0.6);
    EXPECT_EQ(motors[2].axis, 1U);
    const LinearMap map = step_map_of(machine).shares();
    EXPECT_EQ(map.factor(1, 1), 1);
    EXPECT_EQ(map.factor(2, 1), 1.25);
}

/// Each belt moves by the sum of both axes at most, and through the range of both.
TEST(Motors, OfTwoBeltsBearWhatBothAxesDemand) {
    MachineConfig machine;
    machine.axes = {axis("X"), axis("Y")};
    machine.axes[0].motors = {motor("A")};
    machine.axes[1].motors = {motor("B")};
    machine.axes[1].max_velocity_mm_s = 100;
    machine.kinematics.core_xy = {.first = "X", .second = "Y"};
    const std::vector<MotorConfig> motors = motors_of(machine);
    const LinearMap map = motor_map_of(machine);
    EXPECT_EQ(map.place(0, std::vector<double>{10, 4}), 14);
    EXPECT_EQ(map.place(1, std::vector<double>{10, 4}), 6);
    EXPECT_FALSE(motors[0].moves_one_axis);
    for (const MotorConfig& each : motors) { EXPECT_EQ(each.max_velocity_mm_s, 300); }
    EXPECT_EQ(motors[0].position_min_mm, -2);
    EXPECT_EQ(motors[0].position_max_mm, 600);
    EXPECT_EQ(motors[1].position_min_mm, -301);
    EXPECT_EQ(motors[1].position_max_mm, 301);
    EXPECT_EQ(motors[0].plant.start_position_mm, 80);
    EXPECT_EQ(motors[1].plant.start_position_mm, 0);
}

/// Y is not square to X: the motor of X must move by 1.2 mm over a metre of Y to keep a line along Y straight.
TEST(Motors, OfASkewedGuideCorrectIt) {
    MachineConfig machine;
    machine.axes = {axis("X"), axis("Y")};
    machine.kinematics.skews = {{.x = "X", .y = "Y", .mm_per_m = 1.2}};
    const LinearMap map = motor_map_of(machine);
    EXPECT_NEAR(map.place(0, std::vector<double>{5, 1000}), 6.2, 1e-12);
    EXPECT_EQ(map.place(1, std::vector<double>{5, 1000}), 1000);
    EXPECT_NEAR(motors_of(machine)[0].max_velocity_mm_s, 200.24, 1e-9);
}

TEST(Motors, FollowTheRowsOfTheMatrix) {
    MachineConfig machine;
    machine.axes = {axis("X"), axis("Z")};
    machine.kinematics.matrix = {{.motor = "Z", .of = {{"X", 0.5}, {"Z", -2}}}};
    const LinearMap map = motor_map_of(machine);
    EXPECT_EQ(map.place(0, std::vector<double>{3, 4}), 3);
    EXPECT_EQ(map.place(1, std::vector<double>{3, 4}), -6.5);
}

/// The simulated motor of a geared axis is as strong as the axis needs.
TEST(Motors, OfGearedAxesAreScaledWithTheirPlants) {
    MachineConfig machine;
    machine.axes = {axis("X")};
    machine.axes[0].plant.max_torque_accel_mm_s2 = 5000;
    machine.axes[0].plant.max_jump_mm_s = 8;
    machine.kinematics.matrix = {{.motor = "X", .of = {{"X", -2}}}};
    const MotorConfig motor = motors_of(machine)[0];
    EXPECT_EQ(motor.plant.max_torque_accel_mm_s2, 10'000);
    EXPECT_EQ(motor.plant.max_jump_mm_s, 16);
    EXPECT_EQ(motor.plant.start_position_mm, -80);
}

/// Its steps do not meet the ends of the travel, and it rests on those beside them.
TEST(Motors, OfGearedAxesMayRestAStepBeyondTheTravel) {
    MachineConfig machine;
    machine.axes = {axis("X")};
    EXPECT_EQ(motors_of(machine)[0].position_max_mm, 300);
    machine.kinematics.matrix = {{.motor = "X", .of = {{"X", 2}}}};
    EXPECT_EQ(motors_of(machine)[0].position_max_mm, 600 + 1.0 / 80);
    EXPECT_EQ(motors_of(machine)[0].position_min_mm, -2 - 1.0 / 80);
}

}  // namespace
}  // namespace lockstep
