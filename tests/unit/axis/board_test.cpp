// A board is ready as soon as its device is found, keeps no position, and holds no frame with a step.
#include <gtest/gtest.h>

#include "core/axis/following/frame_check.hpp"
#include "core/axis/state/axis_position.hpp"
#include "core/kinematics/motors.hpp"
#include "core/motion/frame_limits.hpp"
#include "tests/unit/axis/axis_parts.hpp"

namespace lockstep {
namespace {

class BoardParts : public AxisParts {
protected:
    static MachineConfig with_board() {
        MachineConfig machine = pair_machine();
        machine.boards = {{.name = "IO", .host = "", .device = {}}};
        return machine;
    }
    AxisPosition position{with_board(), MotorIndex{2}, std::unexpected(FaultCode::PositionNotKept)};
};

TEST_F(BoardParts, StandAt0WheneverTheirDeviceIsFound) {
    EXPECT_FALSE(position.homed()) << "no device";
    DeviceStatus status = at_rest();
    status.position = Position::steps(7);  // as another machine left it
    EXPECT_EQ(position.claim(status, false), FaultCode::None);
    EXPECT_TRUE(position.homed());
    EXPECT_EQ(position.in_machine(status.position), Position{});
    position.lose();
    EXPECT_TRUE(position.homed()) << "no stop makes it move";
    position.lose_device();
    EXPECT_FALSE(position.homed());
    EXPECT_EQ(position.unproved(), FaultCode::DeviceMissing);
    EXPECT_EQ(position.claim(status, false), FaultCode::None);
    EXPECT_TRUE(position.homed());
}

TEST_F(BoardParts, HaveNoEncoderAndKeepNoPosition) {
    (void)device.begin_run();
    show(at_rest());
    DeviceStatus status = at_rest();
    (void)position.claim(status, false);
    status.encoder_count = 40;
    EXPECT_EQ(position.following_error(status), 0);
    EXPECT_FALSE(position.keep(device));
}

TEST_F(BoardParts, RefuseATrackWithAStep) {
    const AxisLimits limits = frame_limits_of(with_board(), MotorIndex{2});
    const auto check = [&](Velocity velocity) {
        AxisTrack track;
        track.body.append({{2'000'000}, velocity, {}});
        MotionPoint from;
        return check_track(track, {2'000'000}, false, limits, from);
    };
    EXPECT_EQ(check({}), FaultCode::None);
    const Velocity one_step{static_cast<std::int64_t>(0x1p64 * 0.6e-6)};
    EXPECT_EQ(check(one_step), FaultCode::FrameOutsideTravel);
}

}  // namespace
}  // namespace lockstep
