// The positions of axes outlive their processes. An axis is homed again only if its device proves the position.
#include "tests/unit/virtual/motors/motor_machines.hpp"

namespace lockstep {
namespace {

/// X is process 0, Y process 1. Devices outlive processes. A kept position is on disk at once.
class KeptPositions : public Rig {
protected:
    KeptPositions() : Rig({.machine = small_machine(), .keeps_positions = true}) {}

    void crash_y(double seconds) {
        vm.schedule({.kind = VirtualFault::Kind::Crash,
                     .process = kY,
                     .at = vm.now(),
                     .lasts = {static_cast<std::int64_t>(seconds * 1e6)}});
        wait(seconds + 0.1);
    }
    bool y_is_homed() const { return vm.axis_states()[kY]->homed; }
    FaultCode doubt() const { return vm.axis_states()[kY]->unproved; }
    void run_to(double x, double y) {
        Program program = program_of({{x, y}}, 40, at_);
        ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
        at_ = {x, y};
    }
    std::vector<double> at_{5, 5};
};

TEST_F(KeptPositions, AnAxisThatEndsAtRestRestartsHomedAndTheMachineContinues) {
    home();
    EXPECT_EQ(doubt(), FaultCode::None);
    crash_y(0.05);
    EXPECT_TRUE(y_is_homed());
    EXPECT_EQ(doubt(), FaultCode::None);
    EXPECT_EQ(vm.axis_states()[kY]->phase, AxisPhase::Standby);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
    run_to(30, 20);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    crash_y(1);
    ASSERT_TRUE(y_is_homed());
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    run_to(10, 40);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 4000}));
    EXPECT_NEAR(vm.device(kY).plant().position_mm(), 40, 1e-9) << "its true position";
}

TEST_F(KeptPositions, AnAxisThatWasNeverHomedHasNone) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    EXPECT_EQ(doubt(), FaultCode::PositionNotKept);
    crash_y(0.05);
    EXPECT_FALSE(y_is_homed());
    EXPECT_EQ(doubt(), FaultCode::PositionNotKept);
    home();
    EXPECT_EQ(doubt(), FaultCode::None) << "it is homed now, the past does not matter";
}

/// The process ends in every phase of a job. It kept the position before runs that it did not observe to their end.
TEST_F(KeptPositions, AnAxisThatEndsInMotionRestartsUnhomedAndReportsWhy) {
    home();
    for (int part = 0; part < 10; ++part) {
        run_to(30, 20);
        wait(0.04 + 0.05 * part);
        ASSERT_EQ(vm.state()->phase, MachinePhase::Running) << part;
        crash_y(1.5);
        EXPECT_FALSE(y_is_homed()) << part;
        EXPECT_EQ(doubt(), FaultCode::DeviceHasRun) << part;
        EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
        home();
        at_ = {5, 5};
    }
}

TEST_F(KeptPositions, AnAxisThatEndsInHomingRestartsUnhomed) {
    home();
    for (int part = 0; part < 10; ++part) {
        ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
        wait(0.02 + 0.15 * part);
        if (vm.state()->phase != MachinePhase::Homing) { break; }
        crash_y(3);
        EXPECT_FALSE(y_is_homed()) << part << ": homing invalidates the old zero";
        EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
        home();
    }
}

TEST_F(KeptPositions, AnAxisThatWasStoppedInAnEmergencyStaysUnhomed) {
    home();
    run_to(80, 80);
    wait(0.5);
    (void)ask(CommandKind::EmergencyStop);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 2));
    EXPECT_FALSE(y_is_homed());
    crash_y(0.05);
    EXPECT_FALSE(y_is_homed());
    EXPECT_EQ(doubt(), FaultCode::DeviceHasRun);
}

TEST_F(KeptPositions, AnAxisThatIsPushedMeanwhileRestartsUnhomed) {
    home();
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = kY, .at = vm.now(), .lasts = {100'000}});
    wait(0.05);
    vm.device(kY).plant().push(10);
    wait(0.15);
    EXPECT_FALSE(y_is_homed());
    EXPECT_EQ(doubt(), FaultCode::PositionPushed);
}

/// Homing in place makes no run, so the device cannot prove that an older zero is out of date.
class KeptInPlace : public Rig {
protected:
    KeptInPlace() : Rig({.machine = MachineSetup{two_belts()}, .keeps_positions = true}) {}
};

TEST_F(KeptInPlace, AnAxisRestartsWithTheZeroOfItsLastHoming) {
    home();
    const std::vector<std::int64_t> park = counts();
    ASSERT_EQ(run(program_of({{30, 20}}, 40)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    ASSERT_NE(counts(), park);
    home();
    ASSERT_EQ(counts(), park);
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = kX, .at = vm.now(), .lasts = {50'000}});
    wait(0.15);
    EXPECT_TRUE(vm.axis_states()[kX]->homed);
    EXPECT_EQ(counts(), park);
}

}  // namespace
}  // namespace lockstep
