// Programs that wait for an input (M66): until it is as wanted, or until a person helps.
#include <gtest/gtest.h>

#include "core/kinematics/motors.hpp"
#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kClamp = 0;
constexpr std::size_t kWaitDoor = 1;

MachineConfig machine_with_clamp() {
    MachineConfig machine = small_machine();
    machine.inputs = {{.name = "clamp", .motor = "X", .channel = 3, .use = InputUse::Program, .number = 3},
                      {.name = "door", .motor = "Y", .channel = 4, .use = InputUse::Door}};
    return machine;
}

class InputWaits : public Rig {
protected:
    explicit InputWaits(const VirtualOptions& options = {.machine = MachineSetup{machine_with_clamp()}})
        : Rig(options) {}

    void wait_for(InputMode mode, double seconds) {
        home();
        Program program = program_of({{10, 10}}, 40);
        program.blocks.push_back({2, Pause{.reason = PauseReason::Input,
                                           .text = "until clamp is as wanted",
                                           .wait = InputWait{3, mode, seconds}}});
        program.blocks.push_back({3, ProgramMove{{20, 5}, 40, false}});
        ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Paused, 5)) << describe();
        wait(0.05);
    }
    void set(std::size_t input, bool closed) {
        vm.set_input(input, closed);
        wait(0.05);
    }
    PauseReason reason() const { return vm.state()->pause->why.reason; }
    void expect_waits() {
        ASSERT_EQ(vm.state()->phase, MachinePhase::Paused) << describe();
        EXPECT_EQ(reason(), PauseReason::Input);
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000}));
    }
    void expect_goes_on() {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 500}));
    }
};

TEST_F(InputWaits, GoOnByThemselvesWhenTheInputIsClosed) {
    wait_for(InputMode::IsClosed, 5);
    expect_waits();
    set(kClamp, true);
    expect_goes_on();
}

TEST_F(InputWaits, GoOnAtOnceIfTheInputIsAsWanted) {
    set(kClamp, true);
    home();
    Program program = program_of({{10, 10}}, 40);
    program.blocks.push_back({2, Pause{.reason = PauseReason::Input, .wait = InputWait{3, InputMode::IsClosed, 1}}});
    program.blocks.push_back({3, ProgramMove{{20, 5}, 40, false}});
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    expect_goes_on();
}

TEST_F(InputWaits, ForAnEdgeAreNotEndedByALevel) {
    set(kClamp, true);
    wait_for(InputMode::Closes, 5);
    expect_waits();
    set(kClamp, false);
    expect_waits();
    set(kClamp, true);
    expect_goes_on();
}

TEST_F(InputWaits, ForAnOpeningEndWhenTheInputOpens) {
    wait_for(InputMode::Opens, 5);
    expect_waits();
    set(kClamp, true);
    expect_waits();
    set(kClamp, false);
    expect_goes_on();
}

TEST_F(InputWaits, ThatTimeOutPauseAndWaitAgainAfterAResume) {
    wait_for(InputMode::IsClosed, 0.3);
    wait(0.4);
    ASSERT_EQ(vm.state()->phase, MachinePhase::Paused);
    EXPECT_EQ(reason(), PauseReason::InputTimeout);
    set(kClamp, true);
    wait(1);
    EXPECT_EQ(reason(), PauseReason::InputTimeout) << "only a person lets the job go on";
    set(kClamp, false);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    wait(0.1);
    expect_waits();
    set(kClamp, true);
    expect_goes_on();
}

TEST_F(InputWaits, SayHowLongUntilTheyTimeOut) {
    wait_for(InputMode::IsClosed, 5);
    const double before = vm.state()->pause->wait_left_s;
    EXPECT_GT(before, 4);
    EXPECT_LE(before, 5);
    wait(1);
    EXPECT_NEAR(vm.state()->pause->wait_left_s, before - 1, 0.02);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    wait(0.1);
    EXPECT_EQ(vm.state()->pause->wait_left_s, 0) << "a held job does not wait for the input";
}

TEST_F(InputWaits, ThatAreHeldDoNotGoOnBeforeAResume) {
    wait_for(InputMode::IsClosed, 5);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    set(kClamp, true);
    wait(0.5);
    ASSERT_EQ(vm.state()->phase, MachinePhase::Paused);
    EXPECT_EQ(reason(), PauseReason::Hold);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    expect_goes_on();
}

TEST_F(InputWaits, DoNotGoOnWhileADoorIsOpen) {
    wait_for(InputMode::IsClosed, 5);
    set(kWaitDoor, true);
    set(kClamp, true);
    wait(0.5);
    ASSERT_EQ(vm.state()->phase, MachinePhase::Paused);
    EXPECT_EQ(reason(), PauseReason::Hold);
    set(kWaitDoor, false);
    ASSERT_EQ(vm.state()->phase, MachinePhase::Paused) << "a person resumes";
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    expect_goes_on();
}

TEST_F(InputWaits, AreEndedByAStop) {
    wait_for(InputMode::IsClosed, 5);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1));
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    set(kClamp, true);
    wait(0.5);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000}));
}

TEST_F(InputWaits, AreEndedByAnEmergencyStop) {
    wait_for(InputMode::IsClosed, 5);
    ASSERT_EQ(ask(CommandKind::EmergencyStop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1));
    set(kClamp, true);
    wait(0.5);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Fault);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000}));
}

/// Two coordinators; the one that takes over continues jobs in motion.
class InputWaitsWithStandby : public InputWaits {
protected:
    InputWaitsWithStandby()
        : InputWaits(
              {.machine = MachineSetup{machine_with_clamp()}, .on_takeover = OnTakeover::Continue, .coordinators = 2}) {
    }

    void lose_owner() {
        const std::size_t owner = vm.owner().value();
        vm.schedule({.kind = VirtualFault::Kind::Crash, .process = owner, .at = vm.now(), .lasts = Ticks{100'000'000}});
        const auto is_over = [&] { return vm.owner() && *vm.owner() != owner; };
        ASSERT_TRUE(vm.advance_until(is_over, Ticks{5'000'000})) << describe();
    }
};

TEST_F(InputWaitsWithStandby, EndWithATakeoverAndTheInputMovesNothingMore) {
    wait_for(InputMode::IsClosed, 5);
    lose_owner();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped) << "the standby continues only what was in motion";
    EXPECT_FALSE(vm.state()->pause);
    set(kClamp, true);
    wait(1);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000}));
    Program rest = program_of({{20, 5}}, 40, {10, 10});
    ASSERT_EQ(run(rest).status, ReplyStatus::Accepted) << "without homing";
    expect_goes_on();
}

TEST_F(InputWaits, AllowNoJogBecauseTheJobMayGoOnAtAnyTime) {
    wait_for(InputMode::IsClosed, 5);
    Jogger jogger(vm);
    jogger.press({{.axis = AxisIndex{0}, .speed_mm_s = 20, .distance_mm = 3}});
    pass(vm, {&jogger}, Ticks{100'000});
    ASSERT_NE(jogger.reply(), nullptr);
    EXPECT_EQ(jogger.reply()->status, ReplyStatus::Refused);
    EXPECT_NE(jogger.reply()->text.find("waits for an input"), std::string::npos) << jogger.reply()->text;
    expect_waits();
}

TEST_F(InputWaits, KeepAnOverrideThatWasSetMeanwhile) {
    wait_for(InputMode::IsClosed, 5);
    Command command{.client = 70, .sequence = 1, .kind = CommandKind::Override, .feed_percent = 50};
    vm.send(command);
    wait(0.1);
    EXPECT_EQ(vm.state()->overrides.feed_percent, 50);
    set(kClamp, true);
    expect_goes_on();
}

TEST_F(InputWaits, ForAnInputThatTheMachineLacksAreRefused) {
    home();
    Program program = program_of({{10, 10}}, 40);
    program.blocks.push_back({2, Pause{.reason = PauseReason::Input, .wait = InputWait{4, InputMode::IsClosed, 1}}});
    const Reply refused = run(program);
    EXPECT_EQ(refused.status, ReplyStatus::Refused);
    EXPECT_NE(refused.text.find("input 4 is not configured"), std::string::npos) << refused.text;
}

}  // namespace
}  // namespace lockstep
