// Emergency stops and doors that are wired to inputs of devices.
#include <gmock/gmock.h>

#include <map>

#include "core/kinematics/motors.hpp"
#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr std::size_t kStop = 0;
constexpr std::size_t kDoor = 1;

MachineConfig machine_with_inputs() {
    MachineConfig machine = small_machine();
    machine.inputs = {{.name = "stop", .motor = "Y", .channel = 3, .use = InputUse::EmergencyStop, .active_low = true},
                      {.name = "door", .motor = "X", .channel = 5, .use = InputUse::Door, .active_low = true}};
    return machine;
}

class Inputs : public Rig, public VirtualObserver {
protected:
    explicit Inputs(MachineConfig machine = machine_with_inputs())
        : Rig({.machine = MachineSetup{std::move(machine)}}) {
        vm.observe(*this);
    }
    void on_step(MotorIndex axis, StepEdge step) override { last_step[axis] = step.tick; }

    void set(std::size_t input, bool closed) {
        const InputConfig& one = vm.machine().inputs[input];
        set_input(vm.device(motor_named(vm.machine(), one.motor).value()).plant(), one, closed);
    }
    void begin_program() {
        home();
        ASSERT_EQ(run(program_of({{85, 45}, {20, 10}}, 40)).status, ReplyStatus::Accepted);
        wait(0.8);
        ASSERT_FALSE(vm.axis_states()[kX]->at_rest);
    }
    void expect_at_rest_for(double seconds) {
        const auto at = counts();
        wait(seconds);
        EXPECT_EQ(counts(), at);
    }
    static FaultCode why(const Reply& reply) {
        return reply.status == ReplyStatus::Refused ? reply.fault : FaultCode::None;
    }

    std::map<std::size_t, Tick> last_step;
};

TEST_F(Inputs, AnEmergencyStopCeasesPulsesOfItsDeviceAfterItsDebounceAndOfAllOthersSoonAfter) {
    begin_program();
    set(kStop, true);
    const Tick pressed = vm.now();
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    wait(0.5);
    EXPECT_LE(last_step[kY], pressed + Ticks{1000}) << "the debounce is 1 ms";
    EXPECT_LE(last_step[kX], pressed + Ticks{1000} + vm.machine().slot_ticks() * 4);
    EXPECT_EQ(fault(), FaultCode::EmergencyStopInput);
    EXPECT_EQ(vm.state()->fault_motor, kY) << "the fault is of the motor whose device has the input";
    EXPECT_EQ(axis_fault(kY), FaultCode::EmergencyStopInput);
    EXPECT_EQ(axis_fault(kX), FaultCode::EmergencyStopped);
}

TEST_F(Inputs, AnEmergencyStopRefusesAResetWhileItIsClosedAndTheMachineWorksAfterReleaseAndReset) {
    begin_program();
    set(kStop, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    const Reply refused = ask(CommandKind::Reset);
    EXPECT_EQ(why(refused), FaultCode::EmergencyStopInput);
    EXPECT_THAT(refused.text, HasSubstr("input stop of motor Y is closed; release it, then reset"));
    expect_at_rest_for(0.5);
    set(kStop, false);
    wait(0.1);
    EXPECT_EQ(fault(), FaultCode::EmergencyStopInput) << "a release alone resets nothing";
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    EXPECT_EQ(why(run(program_of({{10, 10}}, 20))), FaultCode::NotHomed) << "the pulses ceased in motion";
    home();
    ASSERT_EQ(run(program_of({{10, 10}}, 20)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000}));
}

TEST_F(Inputs, AnEmergencyStopAtRestLetsNoMotionBeginAndLosesNoPosition) {
    home();
    set(kStop, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    EXPECT_EQ(why(ask(CommandKind::Home)), FaultCode::InFault);
    expect_at_rest_for(0.5);
    set(kStop, false);
    wait(0.1);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    ASSERT_EQ(run(program_of({{10, 10}}, 20)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
}

TEST_F(Inputs, AnEmergencyStopInHomingStopsAllAxes) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.3);
    set(kStop, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    EXPECT_EQ(fault(), FaultCode::EmergencyStopInput);
    expect_at_rest_for(0.5);
    set(kStop, false);
    wait(0.1);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    home();
}

/// The axis of the input vetoes all further frames, and the other one brakes on its tail.
TEST_F(Inputs, AnEmergencyStopBringsAllAxesToRestWithoutACoordinator) {
    begin_program();
    vm.schedule(
        {.kind = VirtualFault::Kind::Crash, .process = kCoordinator, .at = vm.now(), .lasts = Ticks{5'000'000}});
    set(kStop, true);
    wait(1);
    expect_at_rest_for(0.5);
    EXPECT_EQ(axis_fault(kY), FaultCode::EmergencyStopInput);
}

TEST_F(Inputs, AnEmergencyStopThatIsPressedWhenTheMachineStartsIsItsFault) {
    MachineConfig machine = machine_with_inputs();
    VirtualMachine other({.machine = MachineSetup{machine}});
    set_input(other.device(kY).plant(), machine.inputs[kStop], true);
    const auto is_in_fault = [&] { return other.state() && other.state()->phase == MachinePhase::Fault; };
    ASSERT_TRUE(other.advance_until(is_in_fault, Ticks{2'000'000}));
    EXPECT_EQ(other.state()->fault, FaultCode::EmergencyStopInput);
}

TEST_F(Inputs, ThatNobodyTouchesAreOpenFromPowerUpOn) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    for (const auto& state : vm.axis_states()) { EXPECT_EQ(state->inputs, 0U); }
}

TEST_F(Inputs, ADoorHoldsTheProgramOnItsPathAndItGoesOnAfterClosingAndResuming) {
    begin_program();
    set(kDoor, true);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    EXPECT_EQ(vm.axis_states()[kX]->inputs, 1U << 5);
    const Reply refused = ask(CommandKind::Resume);
    EXPECT_EQ(why(refused), FaultCode::DoorOpen);
    EXPECT_THAT(refused.text, HasSubstr("input door of motor X is closed; close the door"));
    expect_at_rest_for(0.5);
    set(kDoor, false);
    expect_at_rest_for(0.5);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Holding) << "nothing goes on by itself";
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000}));
}

TEST_F(Inputs, NoMotionBeginsWhileADoorIsOpen) {
    home();
    set(kDoor, true);
    wait(0.1);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle);
    EXPECT_EQ(why(ask(CommandKind::Home)), FaultCode::DoorOpen);
    EXPECT_EQ(why(run(program_of({{10, 10}}, 20))), FaultCode::DoorOpen);
    vm.give_program(100, program_of({{10, 10}}, 0));
    EXPECT_EQ(why(ask(CommandKind::MoveOwn, {}, 100)), FaultCode::DoorOpen);
    set(kDoor, false);
    wait(0.1);
    EXPECT_EQ(run(program_of({{10, 10}}, 20)).status, ReplyStatus::Accepted);
}

TEST_F(Inputs, ADoorEndsHomingAndMovesOfAxesOnTheirOwn) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.3);
    set(kDoor, true);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    expect_at_rest_for(0.5);
    set(kDoor, false);
    wait(0.1);
    home();
    vm.give_program(100, program_of({{95, 5}}, 0));
    ASSERT_EQ(ask(CommandKind::MoveOwn, {}, 100).status, ReplyStatus::Accepted);
    wait(0.5);
    set(kDoor, true);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    expect_at_rest_for(0.5);
}

TEST_F(Inputs, ADoorEndsAJogAndAKeyThatIsHeldMovesNothingWhileItIsOpen) {
    home();
    Jogger jogger(vm);
    jogger.press({{.axis = AxisIndex{kX}, .speed_mm_s = 10}});
    pass(vm, {&jogger}, Ticks{300'000});
    ASSERT_FALSE(vm.axis_states()[kX]->at_rest);
    set(kDoor, true);
    pass(vm, {&jogger}, Ticks{500'000});
    const auto at = counts();
    jogger.press({{.axis = AxisIndex{kY}, .speed_mm_s = 10}});
    pass(vm, {&jogger}, Ticks{300'000});
    EXPECT_EQ(counts(), at);
    ASSERT_NE(jogger.reply(), nullptr);
    EXPECT_EQ(jogger.reply()->fault, FaultCode::DoorOpen);
}

}  // namespace
}  // namespace lockstep
