// When an axis accepts a position that was kept at rest, and which doubt it names if it does not.
#include "core/axis/device/position_claim.hpp"

#include <gtest/gtest.h>

#include "core/kinematics/following_error.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

MachineConfig mill() {
    MachineConfig machine{.name = "mill"};
    machine.axes = {{.name = "X", .steps_per_mm = 80, .homing = {.switch_position_mm = -1}}, {.name = "Y"}};
    return machine;
}

/// X, homed, has ended run 7 at the device's count 1200 and rests there.
class Claim : public testing::Test {
protected:
    FaultCode doubt() const { return doubt_of(kept, scale_of(machine, MotorIndex{0}), device, most()); }
    std::int64_t most() const { return most_following_error(motors_of(machine)[0]); }

    MachineConfig machine = mill();
    DeviceStatus device{.position = Position::steps(1200),
                        .power_up = 42,
                        .run = 7,
                        .run_asked = 7,
                        .finished = true,
                        .encoder_count = 1195};
    KeptPosition kept{.scale = scale_of(mill(), MotorIndex{0}),
                      .power_up = 42,
                      .run = 7,
                      .position = Position::steps(1200),
                      .zero_count = 400,
                      .encoder_zero = -5};
};

TEST_F(Claim, IsProvedByADeviceThatHasRunNothingSince) { EXPECT_EQ(doubt(), FaultCode::None); }

TEST_F(Claim, OfAnotherMachineOrAxisIsForeign) {
    EXPECT_EQ(doubt_of(kept, scale_of(machine, MotorIndex{1}), device, most()), FaultCode::PositionForeign);
    machine.name = "lathe";
    EXPECT_EQ(doubt(), FaultCode::PositionForeign);
}

TEST_F(Claim, MeansNothingWhereCountsMeanSomethingElse) {
    machine.axes[0].steps_per_mm = 160;
    EXPECT_EQ(doubt(), FaultCode::PositionRescaled);
    machine = mill();
    machine.axes[0].homing.switch_position_mm = -2;
    EXPECT_EQ(doubt(), FaultCode::PositionRescaled);
    machine = mill();
    machine.axes[0].homing.toward_min = false;
    EXPECT_EQ(doubt(), FaultCode::PositionRescaled);
    machine = mill();
    machine.axes[0].backlash = BacklashConfig{.mm = 0.1, .speed_mm_s = {}};
    EXPECT_EQ(doubt(), FaultCode::PositionRescaled);
    machine = mill();
    machine.axes[0].max_velocity_mm_s = 1;
    machine.axes[0].homing.park_mm = 9;
    EXPECT_EQ(doubt(), FaultCode::None) << "limits do not move the zero";
}

TEST_F(Claim, EndsWithTheDevicesPower) {
    device.power_up = 43;
    EXPECT_EQ(doubt(), FaultCode::DevicePoweredUp) << "though every count be the same";
}

TEST_F(Claim, IsRefusedByADeviceThatHasRunOrIsAboutTo) {
    device.run = device.run_asked = 8;
    EXPECT_EQ(doubt(), FaultCode::DeviceHasRun) << "though it stand at the same count again";
    device.run = 7;
    EXPECT_EQ(doubt(), FaultCode::DeviceHasRun) << "asked for, not begun";
    device.run_asked = 7;
    device.finished = false;
    EXPECT_EQ(doubt(), FaultCode::DeviceHasRun);
    device.finished = device.moving = true;
    EXPECT_EQ(doubt(), FaultCode::DeviceHasRun);
    device.moving = false;
    EXPECT_EQ(doubt(), FaultCode::None);
}

TEST_F(Claim, AsksForEveryBitOfThePosition) {
    device.position = rest_position(1200, true);
    EXPECT_EQ(doubt(), FaultCode::DeviceHasRun);
    device.position = Position::steps(1201);
    EXPECT_EQ(doubt(), FaultCode::DeviceHasRun);
}

TEST_F(Claim, OfAnAxisThatWasPushedIsRefused) {
    device.encoder_count += 3;
    EXPECT_EQ(doubt(), FaultCode::None);
    device.encoder_count += 1;
    EXPECT_EQ(doubt(), FaultCode::PositionPushed);
    device.encoder_count = 1195 - 4;
    EXPECT_EQ(doubt(), FaultCode::PositionPushed);
    machine.axes[0].max_following_error_mm = 0.05;
    EXPECT_EQ(doubt(), FaultCode::None) << "4 steps of 1/80 mm";
}

}  // namespace
}  // namespace lockstep
