// The position of an axis is known after homing or from the kept position, and is kept once after each run.
#include "core/axis/state/axis_position.hpp"

#include "tests/unit/axis/axis_parts.hpp"

namespace lockstep {
namespace {

class StandingAxis : public AxisParts {
protected:
    AxisPosition& position = condition.position;
};

TEST_F(StandingAxis, IsUnknownUntilTheZeroIsSet) {
    EXPECT_EQ(position.claim(at_rest(), false), FaultCode::PositionNotKept);
    EXPECT_FALSE(position.homed());
    EXPECT_EQ(position.in_machine(Position::steps(100)), Position::steps(100)) << "the device's own counts";
    DeviceStatus status = at_rest();
    status.encoder_count = 7;
    EXPECT_EQ(position.following_error(status), 7) << "all since the device was switched on";
    position.set_zero(40, at_rest());
    EXPECT_TRUE(position.homed());
    EXPECT_EQ(position.in_machine(Position::steps(100)), Position::steps(60));
    EXPECT_EQ(position.in_device(Position::steps(60)), Position::steps(100));
}

TEST_F(StandingAxis, CountsLostStepsFromTheHomingOn) {
    DeviceStatus status = at_rest();
    status.encoder_count = 7;
    position.set_zero(0, status);
    EXPECT_EQ(position.following_error(status), 0);
    status.encoder_count = 5;
    EXPECT_EQ(position.following_error(status), -2);
}

TEST_F(StandingAxis, HasLostStepsBeyondTheLimitOfItsMotor) {
    MachineConfig machine = this->machine();
    const auto has_lost = [&](std::int64_t steps) {
        AxisPosition homed(machine, MotorIndex{0}, std::unexpected(FaultCode::PositionNotKept));
        homed.set_zero(0, at_rest());
        DeviceStatus status = at_rest();
        status.encoder_count += steps;
        return homed.has_lost_steps(status);
    };
    EXPECT_FALSE(has_lost(-3));
    EXPECT_TRUE(has_lost(-4));
    machine.axes[0].max_following_error_mm = 10 / machine.axes[0].steps_per_mm;
    EXPECT_FALSE(has_lost(10));
    EXPECT_TRUE(has_lost(11));
    EXPECT_TRUE(has_lost(-11));
}

TEST_F(StandingAxis, IsKeptOnceAfterEachRun) {
    (void)device.begin_run();
    show(at_rest());
    EXPECT_FALSE(position.keep(device)) << "not homed";
    position.set_zero(40, at_rest());
    const auto kept = position.keep(device);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->zero_count, 40);
    EXPECT_FALSE(position.keep(device)) << "the same run";
    (void)device.begin_run();
    EXPECT_FALSE(position.keep(device)) << "the new run has not ended";
    show(at_rest());
    EXPECT_TRUE(position.keep(device));
}

/// The axis homes in place, so no run tells the next process that the kept zero has changed.
TEST_F(StandingAxis, IsKeptAgainWithANewZero) {
    (void)device.begin_run();
    show(at_rest());
    position.set_zero(40, at_rest());
    const auto old = position.keep(device);
    ASSERT_TRUE(old);
    position.begin_homing();
    position.set_zero(60, at_rest());
    const auto kept = position.keep(device);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->zero_count, 60);
    EXPECT_EQ(kept->run, old->run);
    EXPECT_FALSE(position.keep(device)) << "the same zero";
}

TEST_F(StandingAxis, KeptByTheProcessBeforeHomesTheAxis) {
    (void)device.begin_run();
    show(at_rest());
    DeviceStatus status = at_rest();
    status.encoder_count = 7;
    position.set_zero(40, status);
    AxisPosition next(machine(), MotorIndex{0}, *position.keep(device));
    EXPECT_EQ(next.claim(status, true), FaultCode::DeviceFault);
    EXPECT_EQ(next.claim(status, false), FaultCode::None);
    EXPECT_TRUE(next.homed());
    EXPECT_EQ(next.zero_count(), 40);
    EXPECT_EQ(next.following_error(status), 0);
    EXPECT_FALSE(next.keep(device)) << "nothing has moved since";
}

TEST_F(StandingAxis, IsLostWithTheDevice) {
    position.set_zero(40, at_rest());
    position.lose_device();
    EXPECT_FALSE(position.homed());
    EXPECT_EQ(position.unproved(), FaultCode::DeviceMissing);
}

}  // namespace
}  // namespace lockstep
