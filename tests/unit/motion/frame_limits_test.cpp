// The limits that frames keep. They are below an axis's own limits if its device has a clock of its own, because
// corrections of that clock change speeds.
#include "core/motion/frame_limits.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

MachineConfig machine_by(TimeSource source) {
    MachineConfig machine{.timing = {.time_source = source}};
    machine.axes = {{.name = "X",
                     .steps_per_mm = 100,
                     .start_velocity_mm_s = 10,
                     .max_velocity_mm_s = 100,
                     .max_accel_mm_s2 = 1000,
                     .max_decel_mm_s2 = 800,
                     .position_max_mm = 100}};
    return machine;
}

TEST(FrameLimits, LeaveRoomForWhatTheClocksChange) {
    const MachineConfig machine = machine_by(TimeSource::Network);
    const AxisLimits own = limits_of(machine.axes[0], machine.tick_ns);
    const AxisLimits frames = frame_limits_of(machine, MotorIndex{0});
    EXPECT_DOUBLE_EQ(frames.max_velocity, own.max_velocity * (1 - clock_reserve::kSpeed));
    EXPECT_DOUBLE_EQ(frames.start_velocity, own.start_velocity * (1 - clock_reserve::kAcceleration));
    EXPECT_DOUBLE_EQ(frames.max_acceleration, own.max_acceleration * (1 - clock_reserve::kAcceleration));
    EXPECT_DOUBLE_EQ(frames.max_deceleration, own.max_deceleration * (1 - clock_reserve::kAcceleration));
    EXPECT_EQ(frames.max_steps, own.max_steps);
}

TEST(FrameLimits, LeaveRoomOnlyForAnAxisWhoseDeviceHasAClockOfItsOwn) {
    MachineConfig machine = machine_by(TimeSource::Shared);
    machine.axes.push_back(machine.axes[0]);
    machine.axes[1].device = {DeviceName::Kind::Mapped, "/dev/uio0"};
    EXPECT_EQ(frame_limits_of(machine, MotorIndex{0}).max_velocity,
              limits_of(machine.axes[0], machine.tick_ns).max_velocity);
    EXPECT_LT(frame_limits_of(machine, MotorIndex{1}).max_velocity,
              limits_of(machine.axes[1], machine.tick_ns).max_velocity);
}

TEST(FrameLimits, AreTheAxisOwnWhereAllHaveOneClock) {
    const MachineConfig machine = machine_by(TimeSource::Ptp);
    EXPECT_EQ(frame_limits_of(machine, MotorIndex{0}).start_velocity,
              limits_of(machine.axes[0], machine.tick_ns).start_velocity);
}

}  // namespace
}  // namespace lockstep
