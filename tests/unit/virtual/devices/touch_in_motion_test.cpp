// A probe that touches while the machine moves without a probing move: the machine comes to rest, as its input asks.
#include <gmock/gmock.h>

#include "core/kinematics/motor_inputs.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

MachineConfig machine_with(TouchInMotion reaction) {
    MachineConfig machine = small_machine();
    machine.inputs = {{.name = "tip",
                       .motor = "Y",
                       .channel = 3,
                       .use = InputUse::Probe,
                       .number = 0,
                       .max_overshoot_mm = 20,
                       .at_touch_in_motion = reaction}};
    return machine;
}

class TouchesInMotion : public Rig {
protected:
    explicit TouchesInMotion(TouchInMotion reaction) : Rig({.machine = MachineSetup{machine_with(reaction)}}) {}

    void begin(const std::vector<double>& place = {45, 25}) {
        home();
        Program program = program_of({place}, 10);
        program.blocks.front().line = 7;
        ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Running, 2));
        wait(1);
    }
    void touch(bool closed = true) { vm.set_input(0, closed); }
    bool is_on_path() const {
        const auto at = counts();
        return std::abs((at[kX] - 500) - 2 * (at[kY] - 500)) <= 2 && at[kX] > 500 && at[kX] < 4500;
    }
};

class FaultsAtTouches : public TouchesInMotion {
protected:
    FaultsAtTouches() : TouchesInMotion(TouchInMotion::Fault) {}
};

TEST_F(FaultsAtTouches, StopTheMachineOnItsPathInAFaultThatNamesTheInputAndTheLine) {
    begin();
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::TouchInMotion);
    ASSERT_EQ(vm.state()->fault_motor, kY);
    EXPECT_EQ(causes_of(vm.machine(), "Y", fault()), "input tip of motor Y");
    EXPECT_EQ(vm.state()->line, 7);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Failed);
    EXPECT_TRUE(is_on_path());
}

TEST_F(FaultsAtTouches, AreLeftByAResetAndAMoveAway) {
    begin();
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    for (const auto& state : vm.axis_states()) { EXPECT_TRUE(state->homed); }
    const auto at = counts();
    const std::vector<double> here{static_cast<double>(at[kX]) / 100, static_cast<double>(at[kY]) / 100};
    ASSERT_EQ(run(program_of({{5, 5}}, 20, here)).status, ReplyStatus::Accepted);
    wait(0.5);
    touch(false);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 9)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

TEST_F(FaultsAtTouches, DoNotFollowFromAProbingMoveOfTheInput) {
    home();
    Program program = program_of({}, 0);
    program.blocks.push_back({1, Probe{}});
    program.blocks.push_back({1, ProgramMove{.target_mm = {45, 25}, .feed_mm_s = 10}});
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    wait(1.5);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_TRUE(vm.state()->probe->touched());
}

TEST_F(FaultsAtTouches, DoNotFollowFromATouchAtRest) {
    home();
    touch();
    wait(0.5);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle);
    ASSERT_EQ(run(program_of({{10, 10}}, 20)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 9)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
}

class HoldsAtTouches : public TouchesInMotion {
protected:
    HoldsAtTouches() : TouchesInMotion(TouchInMotion::Hold) {}
};

TEST_F(HoldsAtTouches, LetAPersonResumeTheJob) {
    begin();
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    EXPECT_TRUE(is_on_path());
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{4500, 2500}));
}

class IgnoresTouches : public TouchesInMotion {
protected:
    IgnoresTouches() : TouchesInMotion(TouchInMotion::Nothing) {}
};

TEST_F(IgnoresTouches, RunTheProgramToItsEnd) {
    begin();
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{4500, 2500}));
}

}  // namespace
}  // namespace lockstep
