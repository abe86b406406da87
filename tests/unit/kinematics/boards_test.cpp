// Boards stand behind the motors in every list, and kinematics leaves them out.
#include <gtest/gtest.h>

#include "core/kinematics/kinematics.hpp"
#include "core/kinematics/motor_inputs.hpp"

namespace lockstep {
namespace {

AxisConfig moving_axis(const std::string& name) {
    AxisConfig axis;
    axis.name = name;
    axis.steps_per_mm = 80;
    axis.start_velocity_mm_s = 5;
    axis.max_velocity_mm_s = axis.max_accel_mm_s2 = axis.max_decel_mm_s2 = 200;
    axis.position_max_mm = 300;
    return axis;
}

MachineConfig machine_with_board() {
    MachineConfig machine;
    machine.axes = {moving_axis("X"), moving_axis("Y")};
    machine.boards = {{.name = "IO", .host = "shed", .device = {DeviceName::Kind::Shared, "io"}}};
    return machine;
}

TEST(Boards, HaveTheNumbersBehindTheMotors) {
    const MachineConfig machine = machine_with_board();
    EXPECT_EQ(motor_count(machine), 3U);
    EXPECT_EQ(moving_motor_count(machine), 2U);
    EXPECT_EQ(motor_names(machine), (std::vector<std::string>{"X", "Y", "IO"}));
    EXPECT_EQ(moving_motor_names(machine), (std::vector<std::string>{"X", "Y"}));
    EXPECT_EQ(motor_named(machine, "IO"), 2U);
    const MotorConfig board = motors_of(machine)[2];
    EXPECT_TRUE(board.is_board());
    EXPECT_EQ(board.host, "shed");
    EXPECT_EQ(board.device.text(), "shm:io");
    EXPECT_EQ(limits_of(board, 1000).min_steps, 0);
    EXPECT_EQ(limits_of(board, 1000).max_steps, 0) << "it has no travel";
}

TEST(Boards, AreMovedByNoAxisAndAlwaysAt0) {
    const Kinematics kinematics(machine_with_board());
    EXPECT_TRUE(kinematics.is_direct()) << "its motors are its axes, as without the board";
    EXPECT_EQ(kinematics.motors_at({30, -7}).steps, (AxisCounts{30, -7, 0}));
    EXPECT_EQ(kinematics.axes_at({{30, -7, 0}}), (AxisCounts{30, -7}));
    EXPECT_TRUE(kinematics.axes_of_motor(MotorIndex{2}).empty());
    EXPECT_EQ(kinematics.motors_of_axes(AxisSet::first(2)), MotorSet::first(2));
    EXPECT_EQ(kinematics.moving_motors().size(), 2U);
    EXPECT_EQ(kinematics.label(MotorIndex{2}), "board IO");
}

TEST(Boards, OfAGantryAreMovedByNoAxis) {
    MachineConfig machine = machine_with_board();
    machine.axes[1].motors = {{.name = "Y1", .host = "", .steps_per_mm = 80},
                              {.name = "Y2", .host = "", .steps_per_mm = 80}};
    const Kinematics kinematics(machine);
    EXPECT_EQ(kinematics.motors_at({30, -7}).steps, (AxisCounts{30, -7, -7, 0}));
    EXPECT_EQ(kinematics.axes_at({{30, -7, -7, 0}}), (AxisCounts{30, -7}));
    EXPECT_EQ(kinematics.astray({{30, -7, -7, 0}}), std::nullopt);
    EXPECT_TRUE(kinematics.axes_of_motor(MotorIndex{3}).empty());
}

TEST(Boards, WithHardwareHaveAClockOfTheirOwn) {
    MachineConfig machine = machine_with_board();
    EXPECT_FALSE(machine.estimates_clocks());
    machine.boards[0].device = {DeviceName::Kind::Mapped, "/dev/uio0"};
    EXPECT_TRUE(machine.estimates_clocks());
    EXPECT_TRUE(estimates_clock(machine, MotorIndex{2}));
    EXPECT_FALSE(estimates_clock(machine, MotorIndex{0}));
}

TEST(Boards, AreNamedByTheLabelsOfTheirInputs) {
    EXPECT_EQ(label_of(InputConfig{.name = "door", .motor = "IO", .at_board = true}), "input door of board IO");
    EXPECT_EQ(label_of(InputConfig{.name = "door", .motor = "X"}), "input door of motor X");
}

}  // namespace
}  // namespace lockstep
