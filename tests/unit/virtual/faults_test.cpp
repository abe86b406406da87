// The machine's reactions to processes that stall, end and restart, and to links that fail.
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using Kind = VirtualFault::Kind;

/// Axes X (process 0) and Y (1), the coordinator (2). Slots of 1 ms, s = 1.
class Faults : public Rig {
protected:
    void start_job() {
        home();
        ASSERT_EQ(run(program_of({{85, 45}, {20, 60}}, 40)).status, ReplyStatus::Accepted);
        wait(0.8);
    }
    void inject(Kind kind, std::size_t process, double seconds) {
        vm.schedule({.kind = kind, .process = process, .at = vm.now(), .lasts = ticks(seconds)});
    }
    static Ticks ticks(double seconds) { return {static_cast<std::int64_t>(seconds * 1e6)}; }
    /// Expects the true positions of both slides on the line from (5, 5) mm to (85, 45) mm. The tolerance is a frame of
    /// 5 ms that an axis did not receive.
    void expect_on_the_line() {
        const double frame_mm = 40 * 0.005;
        const double x = vm.device(0).plant().position_mm() - 5;
        const double y = vm.device(1).plant().position_mm() - 5;
        EXPECT_NEAR(y, x / 2, frame_mm);
    }
    void expect_usable() {
        EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
        home();
        ASSERT_EQ(run(program_of({{20, 10}}, 40)).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000}));
    }
};

/// How many epochs the coordinator has begun.
class Epochs : public VirtualObserver {
public:
    void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
        for (const JobEvent& job : out.jobs) { begun += job.kind == JobEvent::Kind::EpochBegun ? 1 : 0; }
    }
    int begun = 0;
};

TEST_F(Faults, AnAllowedStallHasNoEffect) {
    Epochs epochs;
    vm.observe(epochs);
    start_job();
    inject(Kind::Freeze, kY, 0.001);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(epochs.begun, 1);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
}

TEST_F(Faults, NothingIsBegunWithoutAnAxis) {
    home();
    inject(Kind::Crash, kY, 100);
    wait(1);
    const Reply reply = run(program_of({{20, 10}}, 40));
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_EQ(reply.fault, FaultCode::AxisMissing) << reply.text;
}

TEST_F(Faults, AStalledCoordinatorOnlyCostsTime) {
    Epochs epochs;
    vm.observe(epochs);
    start_job();
    inject(Kind::Freeze, kCoordinator, 0.1);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(epochs.begun, 2) << "rests on the path, and continues by itself";
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
}

TEST_F(Faults, AnAxisThatEndsLeavesTheOtherOnThePath) {
    start_job();
    inject(Kind::Crash, kY, 1);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::AxisLost);
    wait(1.2);
    expect_on_the_line();  // the device of the axis that ended ran on without its process
    EXPECT_FALSE(vm.axis_states()[kY]->homed) << "a new process cannot prove its position";
    EXPECT_TRUE(vm.axis_states()[0]->homed);
    expect_usable();
}

TEST_F(Faults, ARestartedAxisDoesNotHomeByItself) {
    home();
    inject(Kind::Crash, kY, 1);
    StepLog log;
    vm.observe(log);
    wait(3);
    EXPECT_TRUE(log.steps.empty());
    EXPECT_FALSE(vm.axis_states()[kY]->homed);
}

TEST_F(Faults, AnAxisThatRestartsWhileItIsHomedIsLost) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.1);
    inject(Kind::Crash, kY, 0.005);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::AxisLost);
    wait(5);
    expect_usable();
}

/// The axes have executed as many commands of the previous coordinator as the new one has given. These must not count
/// as executed commands of the new one.
TEST_F(Faults, AwaitsAResetByARestartedCoordinator) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    wait(0.3);
    const Term before = vm.state()->term;
    inject(Kind::Crash, kCoordinator, 0.1);
    wait(0.01);
    (void)vm.command(CommandKind::EmergencyStop);
    ASSERT_TRUE(vm.advance_until([&] { return vm.state()->term > before && vm.state()->phase == MachinePhase::Fault; },
                                 Ticks{3'000'000}))
        << describe();
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    EXPECT_TRUE(vm.advance_until([&] { return vm.state()->phase == MachinePhase::Idle; }, Ticks{1'000'000}))
        << describe();
}

TEST_F(Faults, AnAxisThatRestartsWhileTheJobIsHeldIsLost) {
    start_job();
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    inject(Kind::Crash, kY, 0.005);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << "nothing is resumed with it";
    EXPECT_EQ(fault(), FaultCode::AxisLost);
    expect_usable();
}

TEST_F(Faults, ANewCoordinatorIsIdleOnlyWhenAxesThatHaltedWithoutOneAreReset) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.1);
    inject(Kind::Crash, kCoordinator, 0.05);
    wait(0.1);
    ASSERT_TRUE(vm.advance_until([&] { return vm.state()->phase == MachinePhase::Fault; }, ticks(20)));
    EXPECT_EQ(fault(), FaultCode::CoordinatorSilent);
    EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(vm.advance_until([&] { return vm.state()->phase == MachinePhase::Idle; }, ticks(20)));
    for (const auto& state : vm.axis_states()) { EXPECT_TRUE(state->at_rest); }
    EXPECT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
}

TEST_F(Faults, AnAxisCutOffFromAllIsReportedAndTheMachineUsableAgain) {
    start_job();
    inject(Kind::Cut, kY, 0.5);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_TRUE(fault() == FaultCode::AxisLost || fault() == FaultCode::FramesDiffer) << name_of(fault());
    wait(1);
    expect_usable();
}

TEST_F(Faults, AfterLostStepsAHomingMakesTheAxisGoodAgain) {
    start_job();
    vm.device(kY).plant().push(-20);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::FollowingError);
    expect_usable();
}

class RigFarBehindSwitch : public Rig {
protected:
    RigFarBehindSwitch()
        : Rig({.machine = MachineSetup{[] {
                   MachineConfig machine = small_machine();
                   machine.axes[0].homing.switch_position_mm = 40;
                   machine.axes[0].homing.park_mm = 50;
                   machine.axes[0].plant.start_position_mm = 3;
                   return machine;
               }()}}) {}
};

TEST_F(RigFarBehindSwitch, AnAxisMovesAwayFromItsSwitchHoweverFarThatIs) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
    EXPECT_EQ(counts()[0], 5000);
    EXPECT_NEAR(vm.device(0).plant().position_mm(), 50, 0.011);
}

}  // namespace
}  // namespace lockstep
