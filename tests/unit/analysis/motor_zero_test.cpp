// The positions of a motor tell when its zero moves, and by how much.
#include "services/record/reading/positions/motor_zero.hpp"

#include <gtest/gtest.h>

namespace lockstep::analysis {
namespace {

using Why = ZeroMove::Why;

/// One motor of 100 steps/mm that homes at 5 mm.
MachineConfig machine_that_homes(HomingWay way) {
    MachineConfig machine;
    machine.axes = {AxisConfig{.name = "X", .steps_per_mm = 100}};
    machine.axes[0].homing.way = way;
    machine.axes[0].homing.park_mm = 5;
    return machine;
}

class ZeroOfAMotor : public testing::Test {
protected:
    void set_way(HomingWay way) { zero.set_machine(machine_that_homes(way), "X"); }
    void expect_move(const std::optional<ZeroMove>& move) const {
        EXPECT_EQ(zero.move_between(before, position), move);
        EXPECT_EQ(zero.differs_between(before, position), move.has_value());
    }

    MotorZero zero;
    RecordedPosition before{.tick = Tick{100}, .steps = 700, .sequence = 7, .is_homed = true};
    RecordedPosition position{.tick = Tick{200}, .steps = 700, .sequence = 8, .is_homed = true};
};

TEST_F(ZeroOfAMotor, StaysWhileTheMotorMoves) {
    set_way(HomingWay::InPlace);
    position.steps = 500;
    position.velocity_mm_per_s = -3;
    expect_move(std::nullopt);
    before.velocity_mm_per_s = -3;
    position.velocity_mm_per_s = 0;
    expect_move(std::nullopt);
}

TEST_F(ZeroOfAMotor, MovesWithAHoming) {
    set_way(HomingWay::BySwitch);
    before.is_homed = false;
    expect_move(ZeroMove{Why::NotHomed});
    position.is_homed = false;
    position.steps = 500;
    expect_move(std::nullopt);
}

TEST_F(ZeroOfAMotor, MovesWithAPlaceThatIsAssumedInAHomingByTouch) {
    set_way(HomingWay::ByTouch);
    before.is_homed = position.is_homed = false;
    expect_move(std::nullopt);
    position.steps = 900;
    expect_move(ZeroMove{Why::NotHomed});
    position.velocity_mm_per_s = 3;
    expect_move(std::nullopt);
}

TEST_F(ZeroOfAMotor, MovesWithAHomingInPlaceAgainstTheJumpToThePark) {
    set_way(HomingWay::InPlace);
    position.steps = 500;
    expect_move(ZeroMove{Why::HomedInPlace, 200});
    position.steps = 501;
    expect_move(std::nullopt);
    set_way(HomingWay::BySwitch);
    position.steps = 500;
    expect_move(std::nullopt);
}

TEST_F(ZeroOfAMotor, MovesWithAHomingInPlaceThatFollowsMissingPositions) {
    set_way(HomingWay::InPlace);
    position.sequence = 12;
    position.steps = 500;
    expect_move(ZeroMove{Why::HomedInPlace, 200});
}

TEST_F(ZeroOfAMotor, MayMoveByAnyJumpAtRestOfAnUnknownMachine) {
    position.steps = 300;
    expect_move(ZeroMove{Why::HomedInPlace, 400});
    before.is_homed = position.is_homed = false;
    expect_move(ZeroMove{Why::NotHomed});
    position.sequence = 9;
    expect_move(std::nullopt);
}

TEST_F(ZeroOfAMotor, MayMoveWithAnotherProcess) {
    set_way(HomingWay::BySwitch);
    position.incarnation = 1;
    expect_move(ZeroMove{Why::OtherProcess});
    before.is_homed = position.is_homed = false;
    expect_move(ZeroMove{Why::NotHomed});
}

TEST_F(ZeroOfAMotor, MovesBackByTheLostStepsThatAreMadeUp) {
    set_way(HomingWay::BySwitch);
    before.following_error = -20;
    position.steps = 680;
    expect_move(ZeroMove{Why::LostSteps, 20});
    before.velocity_mm_per_s = 3;
    expect_move(std::nullopt);
}

TEST_F(ZeroOfAMotor, OfAnUnknownMachineMovesBackByLostStepsIfTheJumpHasTheirNumber) {
    before.following_error = -20;
    position.steps = 680;
    expect_move(ZeroMove{Why::LostSteps, 20});
    position.steps = 681;
    expect_move(ZeroMove{Why::HomedInPlace, 19});
}

TEST_F(ZeroOfAMotor, ShowsNoOtherPlaceIfAFollowingErrorGoesAwayByItself) {
    set_way(HomingWay::BySwitch);
    before.following_error = -20;
    EXPECT_EQ(zero.move_between(before, position), (ZeroMove{Why::LostSteps, 20}));
    EXPECT_FALSE(zero.differs_between(before, position));
}

}  // namespace
}  // namespace lockstep::analysis
