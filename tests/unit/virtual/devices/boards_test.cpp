// A board has no motor, but takes part in everything else: frames, outputs, inputs, faults and records.
#include <gmock/gmock.h>

#include "core/kinematics/motors.hpp"
#include "tests/unit/virtual/motors/motor_machines.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr std::size_t kIo = 2;
constexpr std::size_t kOwner = 3;  // the coordinator
constexpr std::size_t kStopOfBoard = 0;
constexpr std::size_t kDoorOfBoard = 1;
constexpr std::uint16_t kAir = 1U << 4;
constexpr double kNear_mm = 0.2;  // the test looks every few milliseconds

MachineConfig with_board(MachineConfig machine = small_machine()) {
    machine.boards = {{.name = "IO", .host = "", .device = {}}};
    machine.outputs = {{.name = "air", .motor = "IO", .at_board = true, .channel = 4, .number = 3}};
    machine.inputs = {{.name = "stop", .motor = "IO", .at_board = true, .channel = 1, .use = InputUse::EmergencyStop},
                      {.name = "door", .motor = "IO", .at_board = true, .channel = 2, .use = InputUse::Door}};
    return machine;
}

/// Switches the air on behind the first move and off behind the second.
Program switching() {
    Program program = program_of({{45, 25}, {60, 30}, {20, 10}}, 40);
    program.blocks.insert(program.blocks.begin() + 2, {.action = ProgramEvent{ProgramEvent::Kind::OutputOff, 3}});
    program.blocks.insert(program.blocks.begin() + 1, {.action = ProgramEvent{ProgramEvent::Kind::OutputOn, 3}});
    return program;
}

class Boards : public Rig {
protected:
    explicit Boards(MachineConfig machine = with_board()) : Rig({.machine = MachineSetup{std::move(machine)}}) {}

    /// Of the board's device.
    bool is_air_on() const { return (vm.device(kIo).outputs().digital() & kAir) != 0; }
    std::int64_t steps_of_board() const { return vm.device(kIo).plant().encoder(); }
    void begin_and_reach_air() {
        home();
        ASSERT_EQ(run(switching()).status, ReplyStatus::Accepted);
        ASSERT_TRUE(vm.advance_until([&] { return is_air_on(); }, Ticks{3'000'000})) << describe();
    }
    void kill_board(Ticks lasts) {
        vm.schedule({.kind = VirtualFault::Kind::Crash, .process = kIo, .at = vm.now(), .lasts = lasts});
    }
};

TEST_F(Boards, SwitchTheirOutputsWhereTheProgramAsksAndMakeNoStep) {
    begin_and_reach_air();
    EXPECT_NEAR(vm.device(kX).plant().position_mm(), 45, kNear_mm);
    ASSERT_TRUE(vm.advance_until([&] { return !is_air_on(); }, Ticks{3'000'000}));
    EXPECT_NEAR(vm.device(kX).plant().position_mm(), 60, kNear_mm);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000, 0}));
    EXPECT_EQ(steps_of_board(), 0);
}

TEST_F(Boards, LeaveTheStepsOfTheAxesAsTheyAreWithoutThem) {
    StepLog with;
    vm.observe(with);
    home();
    ASSERT_EQ(run(program_of({{45, 25}, {20, 10}}, 40)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();

    class Without : public Rig {
    public:
        Without() { vm.observe(log); }
        void TestBody() override {
            home();
            ASSERT_EQ(run(program_of({{45, 25}, {20, 10}}, 40)).status, ReplyStatus::Accepted);
            ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
        }
        StepLog log;
    } without;
    without.TestBody();
    ASSERT_EQ(with.steps.size(), without.log.steps.size());
    const auto from_first_of_program = [](const StepLog& log, std::size_t steps) {
        std::vector<StepLog::Step> of(log.steps.end() - static_cast<std::ptrdiff_t>(steps), log.steps.end());
        const std::int64_t begin = of.front().tick;
        for (StepLog::Step& step : of) { step.tick -= begin; }
        return of;
    };
    constexpr std::size_t kSteps = 4000 + 2000 + 2500 + 1500;
    EXPECT_EQ(from_first_of_program(with, kSteps), from_first_of_program(without.log, kSteps));
}

TEST_F(Boards, AreNeverHomed) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    EXPECT_TRUE(vm.axis_states()[kIo]->homed) << "its place is always known";
    EXPECT_EQ(vm.axis_states()[kIo]->phase, AxisPhase::Standby);
    EXPECT_EQ(run(program_of({{10, 10}}, 20)).fault, FaultCode::NotHomed) << "the axes are not homed";
    home();
    EXPECT_EQ(run(program_of({{10, 10}}, 20)).status, ReplyStatus::Accepted);
}

TEST_F(Boards, ThatFallSilentBringTheMachineToRestAndNeedNoHomingAfterwards) {
    begin_and_reach_air();
    kill_board(Ticks{1'000'000});
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::AxisLost);
    EXPECT_EQ(vm.state()->fault_motor, kIo);
    wait(1.5);
    EXPECT_FALSE(is_air_on()) << "its device heard nothing from its process for half a second";
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    for (const auto& state : vm.axis_states()) { EXPECT_TRUE(state->homed); }
    const std::vector<std::int64_t> at = counts();
    ASSERT_EQ(
        run(program_of({{10, 10}}, 40, {static_cast<double>(at[0]) / 100, static_cast<double>(at[1]) / 100})).status,
        ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000, 0}));
}

TEST_F(Boards, VetoAFrameThatTheyDoNotHold) {
    home();
    ASSERT_EQ(run(switching()).status, ReplyStatus::Accepted);
    wait(0.5);
    vm.schedule({.kind = VirtualFault::Kind::DamageFrame, .process = kIo, .at = vm.now(), .lasts = {1}});
    ASSERT_TRUE(reaches(MachinePhase::Fault, 5)) << describe();
    EXPECT_EQ(vm.state()->fault_motor, kIo);
}

TEST_F(Boards, StopTheWholeMachineByTheirInputAndAreReadyAfterReleaseAndReset) {
    begin_and_reach_air();
    vm.set_input(kStopOfBoard, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    wait(0.5);
    EXPECT_EQ(fault(), FaultCode::EmergencyStopInput);
    EXPECT_EQ(vm.state()->fault_motor, kIo);
    EXPECT_FALSE(is_air_on());
    const Reply refused = ask(CommandKind::Reset);
    EXPECT_THAT(refused.text, HasSubstr("input stop of board IO is closed; release it, then reset"));
    vm.set_input(kStopOfBoard, false);
    wait(0.1);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    EXPECT_EQ(vm.axis_states()[kIo]->phase, AxisPhase::Standby);
    home();
    ASSERT_EQ(run(program_of({{10, 10}}, 20)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
}

TEST_F(Boards, HoldTheProgramByTheirDoor) {
    begin_and_reach_air();
    vm.set_input(kDoorOfBoard, true);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    const Reply refused = ask(CommandKind::Resume);
    EXPECT_THAT(refused.text, HasSubstr("input door of board IO is closed; close the door"));
    vm.set_input(kDoorOfBoard, false);
    wait(0.1);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000, 0}));
}

TEST_F(Boards, FollowANewCoordinator) {
    begin_and_reach_air();
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = kOwner, .at = vm.now(), .lasts = Ticks{1'000'000}});
    wait(1.5);
    const auto is_idle = [&] { return vm.state()->phase == MachinePhase::Idle; };
    ASSERT_TRUE(vm.advance_until(is_idle, Ticks{3'000'000})) << describe();
    EXPECT_TRUE(vm.axis_states()[kIo]->homed);
}

class BoardsOfAGantry : public Boards {
protected:
    BoardsOfAGantry() : Boards(with_board(gantry(0.8))) {}
};

TEST_F(BoardsOfAGantry, StandBehindItsMotors) {
    home();
    ASSERT_EQ(run(program_of({{45, 25}, {20, 10}}, 40, {5, 0})).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000, 1000, 0}));
}

}  // namespace
}  // namespace lockstep
