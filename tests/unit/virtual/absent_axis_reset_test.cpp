// A reset that is accepted while an axis is not received applies to that axis too. The axis leaves Fault when it is
// received again.
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using Kind = VirtualFault::Kind;

/// X is process 0, Y process 1.
class AbsentAxisReset : public Rig {
protected:
    void strike_y(Kind kind, double seconds) {
        vm.schedule({.kind = kind, .process = kY, .at = vm.now(), .lasts = {static_cast<std::int64_t>(seconds * 1e6)}});
    }
    void expect_idle_without_another_reset() {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 6)) << describe();
        EXPECT_EQ(fault(), FaultCode::None) << describe();
        EXPECT_EQ(axis_fault(kY), FaultCode::None) << describe();
        home();
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
    }
};

TEST_F(AbsentAxisReset, AxisThatHaltedWithoutItsCoordinatorLeavesFaultWhenItIsBack) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.3);
    strike_y(Kind::Cut, 2);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    EXPECT_EQ(fault(), FaultCode::AxisLost);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    expect_idle_without_another_reset();
}

TEST_F(AbsentAxisReset, AxisThatLostItsDeviceLeavesFaultWhenBothAreBack) {
    home();
    strike_y(Kind::KillDevice, 3);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    EXPECT_EQ(fault(), FaultCode::DeviceLost);
    strike_y(Kind::Cut, 1);
    wait(0.2);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    expect_idle_without_another_reset();
}

TEST_F(AbsentAxisReset, AxisThatIsCutOffBeforeItReceivesTheResetLeavesFaultWhenItIsBack) {
    home();
    strike_y(Kind::KillDevice, 3);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    strike_y(Kind::Cut, 1);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    expect_idle_without_another_reset();
}

/// A reset does not apply to faults that come after it. Each of them needs another reset.
TEST_F(AbsentAxisReset, LaterFaultOfAnAbsentAxisNeedsAnotherReset) {
    home();
    strike_y(Kind::KillDevice, 0.5);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    wait(1);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1)) << describe();
    strike_y(Kind::Cut, 1);
    strike_y(Kind::KillDevice, 2);
    wait(4);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Fault) << describe();
    EXPECT_EQ(fault(), FaultCode::DeviceLost) << describe();
}

}  // namespace
}  // namespace lockstep
