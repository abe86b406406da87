// A device dies, stops, or shows impossible values. In every state the machine goes to Fault, names the axis and the
// fault, and is usable again after the remedy.
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using Kind = VirtualFault::Kind;

/// X is process 0, Y process 1. A device may be silent for 16 slots of 1 ms.
class Devices : public Rig {
protected:
    static constexpr double kSoon = 0.5;  // s, the machine is in Fault by then: the silence, a frame and a tail

    void strike(Kind kind, double seconds, bool garbage = true) {
        vm.schedule({.kind = kind,
                     .process = kY,
                     .at = vm.now(),
                     .lasts = {static_cast<std::int64_t>(seconds * 1e6)},
                     .garbage = garbage});
    }
    void start_job() {
        home();
        ASSERT_EQ(run(program_of({{85, 45}, {20, 60}}, 40)).status, ReplyStatus::Accepted);
        wait(0.8);
    }
    void move_y_on_its_own() {
        home();
        vm.give_program(77, program_of({{5, 90}}, 0));
        ASSERT_EQ(ask(CommandKind::MoveOwn, {}, 77).status, ReplyStatus::Accepted);
        wait(0.3);
    }
    void expect_device_lost() {
        ASSERT_TRUE(reaches(MachinePhase::Fault, kSoon)) << describe();
        EXPECT_EQ(fault(), FaultCode::DeviceLost) << describe();
        EXPECT_EQ(vm.state()->fault_motor, kY);
        for (const auto& axis : vm.axis_states()) { EXPECT_TRUE(axis->at_rest); }
        EXPECT_FALSE(vm.axis_states()[kY]->homed);
    }
    /// The remedy: the device runs again, reset, home.
    void expect_usable() {
        wait(2);
        EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
        wait(0.1);
        home();
        ASSERT_EQ(run(program_of({{20, 10}}, 40)).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000}));
        EXPECT_NEAR(vm.device(kY).plant().position_mm(), 10, 0.011);
    }
};

TEST_F(Devices, OneThatDiesInMotionFailsTheJob) {
    start_job();
    strike(Kind::KillDevice, 1);
    expect_device_lost();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Failed);
    expect_usable();
}

TEST_F(Devices, OneThatDiesAtRestIsAFault) {
    home();
    strike(Kind::KillDevice, 1);
    expect_device_lost();
    expect_usable();
}

TEST_F(Devices, OneThatDiesBeforeItIsHomedIsAFault) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    strike(Kind::KillDevice, 1);
    expect_device_lost();
    expect_usable();
}

TEST_F(Devices, OneThatDiesInHomingEndsIt) {
    for (int part = 0; part < 8; ++part) {
        if (part == 0) { home(); }
        ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
        wait(0.02 + 0.12 * part);
        ASSERT_EQ(vm.state()->phase, MachinePhase::Homing) << part;
        strike(Kind::KillDevice, 1);
        ASSERT_TRUE(reaches(MachinePhase::Fault, kSoon)) << part << ": " << describe();
        EXPECT_EQ(fault(), FaultCode::DeviceLost) << part << ": " << describe();
        wait(4);  // the other axis finishes its homing
        expect_usable();
    }
}

TEST_F(Devices, OneThatDiesInAMoveOfItsAxisEndsIt) {
    move_y_on_its_own();
    strike(Kind::KillDevice, 1);
    expect_device_lost();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Failed);
    expect_usable();
}

TEST_F(Devices, OneThatDiesWhileTheJobIsHeldFailsIt) {
    start_job();
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    strike(Kind::KillDevice, 1);
    expect_device_lost();
    expect_usable();
}

TEST_F(Devices, OneThatDiesWhileTheMachineStopsEndsTheStop) {
    for (const CommandKind kind : {CommandKind::Hold, CommandKind::Stop, CommandKind::EmergencyStop}) {
        start_job();
        strike(Kind::KillDevice, 1);
        ASSERT_EQ(ask(kind).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Fault, kSoon)) << describe();
        expect_usable();
    }
}

TEST_F(Devices, AResetBeforeItReturnsIsAcceptedAndTheMachineWaitsForIt) {
    home();
    strike(Kind::KillDevice, 3);
    expect_device_lost();
    EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    wait(0.5);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Waiting) << describe();
    EXPECT_EQ(vm.axis_states()[kY]->unproved, FaultCode::DeviceMissing);
    const Reply refusal = ask(CommandKind::Home);
    EXPECT_EQ(refusal.status, ReplyStatus::Refused);
    EXPECT_EQ(refusal.fault, FaultCode::DeviceMissing);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 4)) << describe();
    expect_usable();
}

TEST_F(Devices, AnAxisThatStartsBeforeItsDeviceWaitsForItWithoutAFault) {
    strike(Kind::KillDevice, 2);
    wait(1);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Waiting) << describe();
    EXPECT_EQ(fault(), FaultCode::None);
    EXPECT_EQ(vm.axis_states()[kY]->unproved, FaultCode::DeviceMissing);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    home();
}

/// The registers can still be opened without a device, but their clock does not advance.
TEST_F(Devices, MemoryOfADeadOneIsNotTakenForADevice) {
    home();
    strike(Kind::StopDevice, 4);
    expect_device_lost();
    EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    for (int look = 0; look < 30; ++look) {
        wait(0.1);
        EXPECT_EQ(vm.state()->phase, MachinePhase::Waiting) << look;
        EXPECT_EQ(axis_fault(kY), FaultCode::None) << look << ": it is not lost again";
        EXPECT_FALSE(vm.axis_states()[kY]->homed) << look;
    }
    expect_usable();
}

TEST_F(Devices, OneThatStopsAtRestAndContinuesProvesItsPositionAndAResetIsEnough) {
    home();
    strike(Kind::StopDevice, 0.2);
    expect_device_lost();
    wait(0.5);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Fault) << "only a person resets it";
    EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1)) << describe();
    EXPECT_TRUE(vm.axis_states()[kY]->homed);
    ASSERT_EQ(run(program_of({{20, 10}}, 40)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_NEAR(vm.device(kY).plant().position_mm(), 10, 1e-9);
}

TEST_F(Devices, OneThatStopsInMotionAndContinuesComesToRestAndIsNotHomed) {
    start_job();
    strike(Kind::StopDevice, 0.3);
    expect_device_lost();
    wait(1);
    EXPECT_FALSE(vm.device(kY).in_motion());
    EXPECT_FALSE(vm.axis_states()[kY]->homed);
    expect_usable();
}

TEST_F(Devices, OneThatStallsNoLongerThanItMayIsNotNoticed) {
    start_job();
    strike(Kind::StopDevice, 0.012);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(fault(), FaultCode::None) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
}

/// The axis's own standstill proves nothing about its device.
TEST_F(Devices, AnAxisThatStalledForLongDoesNotGiveUpItsDevice) {
    home();
    vm.schedule({.kind = Kind::Freeze, .process = kY, .at = vm.now(), .lasts = {300'000}});
    wait(1);
    EXPECT_NE(axis_fault(kY), FaultCode::DeviceLost) << describe();
    EXPECT_TRUE(vm.axis_states()[kY]->homed);
}

TEST_F(Devices, RegistersThatAreOverwrittenAtAnyInstantAreNoDevice) {
    for (int part = 0; part < 12; ++part) {
        start_job();
        wait(0.0371 * part);
        strike(Kind::Overwrite, 0.05, part % 2 == 0);
        expect_device_lost();
        expect_usable();
    }
}

TEST_F(Devices, RegistersThatAreOverwrittenAtRestAreNoDevice) {
    for (const bool garbage : {true, false}) {
        home();
        strike(Kind::Overwrite, 0.05, garbage);
        expect_device_lost();
        expect_usable();
    }
}

TEST_F(Devices, OneThatIsPoweredUpAgainBetweenTwoReadingsIsAnother) {
    start_job();
    strike(Kind::KillDevice, 0.0001);
    expect_device_lost();
    expect_usable();
}

}  // namespace
}  // namespace lockstep
