// Half a step at the start velocity lasts longer than the frames that are kept ahead and the silence that is allowed.
// An axis that rests between two steps waits so long before it starts.
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

/// Half a step of X takes 50 ms, of Y 500 us.
MachineConfig machine_with_slow_start() {
    MachineConfig machine = small_machine();
    machine.axes[0].start_velocity_mm_s = 0.1;
    return machine;
}

class SlowStart : public Rig {
protected:
    SlowStart() : Rig({.machine = MachineSetup{machine_with_slow_start()}}) {}
};

TEST_F(SlowStart, AxisWaitsHalfAStepAndHomes) {
    home();
    EXPECT_EQ(fault(), FaultCode::None) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
    EXPECT_NEAR(vm.device(0).plant().position_mm(), 5, 0.011);
}

TEST_F(SlowStart, StopDuringTheWaitForTheNextStartEndsHoming) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    const auto before = counts();
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.5);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 0.2)) << describe();
    const auto rested = counts();
    EXPECT_NE(rested[0], before[0]);
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.005);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 0.02)) << describe();
    EXPECT_EQ(fault(), FaultCode::None) << describe();
    EXPECT_EQ(counts()[0], rested[0]);
    home();
}

}  // namespace
}  // namespace lockstep
