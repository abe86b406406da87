// Motors that have lost steps make them up at rest, before the next leg of a job, if the configuration asks for it.
#include <array>
#include <cmath>

#include "tests/unit/virtual/motors/motor_machines.hpp"

namespace lockstep {
namespace {

constexpr double kHomedWithin_mm = 0.011;  // the switch closes within a step

/// More than 2 steps are made up, more than 50 are a fault.
MachineConfig correcting(MachineConfig machine) {
    for (AxisConfig& axis : machine.axes) {
        axis.max_following_error_mm = 0.5;
        axis.correct_following_error_mm = 0.02;
    }
    return machine;
}

/// What motors report about lost steps.
class Losses : public VirtualObserver {
public:
    void on_axis(MotorIndex axis, Tick, const AxisOutputs& out, AxisNode&) override {
        for (const AxisNotice& notice : out.notices) {
            if (notice.kind == AxisNotice::Kind::StepsCorrected) { corrected.emplace_back(axis, notice.number); }
            if (notice.fault == FaultCode::FollowingError) { beyond.push_back(notice.number); }
        }
    }
    std::vector<std::pair<MotorIndex, std::uint64_t>> corrected;
    std::vector<std::uint64_t> beyond;
};

class LostSteps : public Rig {
protected:
    explicit LostSteps(const MachineConfig& machine = correcting(small_machine()))
        : Rig({.machine = MachineSetup{machine}}) {
        vm.observe(losses);
        vm.observe(log);
    }
    /// Goes to (20, 10), and a hand pushes the slide of Y on the way.
    void lose(std::int64_t steps) {
        home();
        ASSERT_EQ(run(program_of({{20, 10}}, 40)).status, ReplyStatus::Accepted);
        wait(0.3);
        ASSERT_EQ(vm.state()->phase, MachinePhase::Running);
        vm.device(kY).plant().push(steps);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
        wait(0.01);
        log.steps.clear();
    }
    void finish(const Program& program) {
        ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
        wait(0.01);
    }
    void resume_with_return() {
        vm.send({.client = 70, .sequence = ++resumes_, .kind = CommandKind::Resume, .returns = true});
        ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
        wait(0.01);
    }
    const AxisState& y() const { return *vm.axis_states()[kY]; }
    double slide_mm(std::size_t motor) const { return vm.device(motor).plant().position_mm(); }
    /// The sum of steps of Y before the first one of X.
    std::int64_t alone() const {
        std::int64_t sum = 0;
        for (const StepLog::Step& step : log.steps) {
            if (step.axis == kX) { break; }
            sum += step.direction;
        }
        return sum;
    }

    Losses losses;
    StepLog log;

private:
    std::uint64_t resumes_ = 0;
};

TEST_F(LostSteps, AreMadeUpBeforeTheNextJob) {
    lose(-20);
    EXPECT_EQ(y().position.count(), 1000) << "by its count";
    EXPECT_EQ(y().following_error_steps, -20);
    EXPECT_NEAR(slide_mm(kY), 9.8, kHomedWithin_mm);
    finish(program_of({{25, 10}}, 40, {20, 10}));
    EXPECT_EQ(alone(), 20);
    EXPECT_EQ(y().following_error_steps, 0);
    EXPECT_EQ(y().corrected_steps, 20U);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2500, 1000}));
    EXPECT_NEAR(slide_mm(kY), 10, kHomedWithin_mm);
    EXPECT_NEAR(slide_mm(kX), 25, kHomedWithin_mm);
    EXPECT_EQ(losses.corrected, (std::vector<std::pair<MotorIndex, std::uint64_t>>{{MotorIndex{kY}, 20}}));
}

TEST_F(LostSteps, AheadOfTheCountAreTakenBack) {
    lose(50);
    finish(program_of({{25, 10}}, 40, {20, 10}));
    EXPECT_EQ(alone(), -50);
    EXPECT_NEAR(slide_mm(kY), 10, kHomedWithin_mm);
}

TEST_F(LostSteps, AreLeftAsTheyAreUpToTheThreshold) {
    lose(-2);
    finish(program_of({{25, 10}}, 40, {20, 10}));
    EXPECT_EQ(alone(), 0);
    EXPECT_EQ(y().following_error_steps, -2);
    EXPECT_TRUE(losses.corrected.empty());
}

TEST_F(LostSteps, AreAFaultBeyondTheLimit) {
    home();
    ASSERT_EQ(run(program_of({{20, 10}}, 40)).status, ReplyStatus::Accepted);
    wait(0.3);
    vm.device(kY).plant().push(-51);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::FollowingError);
    EXPECT_EQ(losses.beyond, std::vector<std::uint64_t>{51});
    EXPECT_FALSE(y().homed);
}

/// No faster than the motor can jump to: it has just shown that its torque is short.
TEST_F(LostSteps, AreMadeUpAtTheStartVelocity) {
    lose(-50);
    finish(program_of({{25, 10}}, 40, {20, 10}));
    const double ticks = 1 / (10 * 100 * 1e-6);  // a step at 10 mm/s
    for (std::size_t k = 1; k < 50; ++k) {
        ASSERT_EQ(log.steps[k].axis, kY);
        EXPECT_GE(static_cast<double>(log.steps[k].tick - log.steps[k - 1].tick), ticks - 1) << k;
    }
}

TEST_F(LostSteps, OfAPauseAreMadeUpBeforeTheNextLeg) {
    home();
    Program program = program_of({{20, 10}}, 40);
    program.blocks.push_back({2, Pause{.reason = PauseReason::ProgramStop}});
    program.blocks.push_back({3, ProgramMove{{25, 10}, 40, false}});
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 5)) << describe();
    vm.device(kY).plant().push(-20);
    wait(0.01);
    log.steps.clear();
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(alone(), 20);
    EXPECT_NEAR(slide_mm(kY), 10, kHomedWithin_mm);
}

TEST_F(LostSteps, HoldWhileTheyAreMadeUpPausesTheJobAtTheTruePlace) {
    lose(-50);
    ASSERT_EQ(run(program_of({{25, 10}}, 40, {20, 10})).status, ReplyStatus::Accepted);
    wait(0.015);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 1)) << describe();
    wait(0.01);
    EXPECT_LT(y().position.count(), 1000);
    EXPECT_GT(y().position.count(), 950);
    EXPECT_NEAR(slide_mm(kY), static_cast<double>(y().position.count()) / 100, kHomedWithin_mm);
    EXPECT_EQ(y().following_error_steps, 0);
    const Reply reply = ask(CommandKind::Resume);
    EXPECT_EQ(reply.fault, FaultCode::AwayFromPause) << reply.text;
    vm.device(kY).plant().push(-10);  // more are lost before the machine returns
    wait(0.01);
    resume_with_return();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2500, 1000}));
    EXPECT_EQ(y().corrected_steps, 60U);
    EXPECT_NEAR(slide_mm(kY), 10, kHomedWithin_mm);
}

TEST_F(LostSteps, StopWhileTheyAreMadeUpEndsTheJob) {
    lose(-50);
    ASSERT_EQ(run(program_of({{25, 10}}, 40, {20, 10})).status, ReplyStatus::Accepted);
    wait(0.015);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1)) << describe();
    wait(0.01);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    EXPECT_EQ(vm.axis_states()[kX]->position.count(), 2000) << "the program has not begun";
    EXPECT_NEAR(slide_mm(kY), static_cast<double>(y().position.count()) / 100, kHomedWithin_mm);
}

/// They are lost again, beyond the limit, while they are made up.
TEST_F(LostSteps, FailTheJobWhenMoreAreLostMeanwhile) {
    lose(-50);
    ASSERT_EQ(run(program_of({{25, 10}}, 40, {20, 10})).status, ReplyStatus::Accepted);
    wait(0.015);
    vm.device(kY).plant().push(-51);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    EXPECT_EQ(fault(), FaultCode::FollowingError);
    EXPECT_EQ(vm.axis_states()[kX]->position.count(), 2000) << "the program has not begun";
}

class LostStepsBehindAWait : public LostSteps {
protected:
    LostStepsBehindAWait()
        : LostSteps([] {
              MachineConfig machine = correcting(small_machine());
              machine.inputs = {{.name = "clamp", .motor = "X", .channel = 3, .use = InputUse::Program, .number = 3}};
              return machine;
          }()) {}
};

/// The input has changed as wanted: the job does not wait for another change.
TEST_F(LostStepsBehindAWait, AreMadeUpWithoutASecondWait) {
    home();
    Program program = program_of({{20, 10}}, 40);
    program.blocks.push_back({2, Pause{.reason = PauseReason::Input,
                                       .text = "until clamp closes",
                                       .wait = InputWait{3, InputMode::Closes, 5}}});
    program.blocks.push_back({3, ProgramMove{{25, 10}, 40, false}});
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 5)) << describe();
    vm.device(kY).plant().push(-20);
    wait(0.05);
    vm.set_input(0, true);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(y().corrected_steps, 20U);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2500, 1000}));
}

class LostStepsAreKept : public Rig {
protected:
    LostStepsAreKept() : Rig({.machine = small_machine()}) {}
};

TEST_F(LostStepsAreKept, WhereTheConfigurationDoesNotAskForMore) {
    home();
    vm.device(kY).plant().push(-3);
    wait(0.01);
    StepLog log;
    vm.observe(log);
    ASSERT_EQ(run(program_of({{25, 5}}, 40)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(std::ranges::count(log.steps, kY, &StepLog::Step::axis), 0);
    EXPECT_EQ(vm.axis_states()[kY]->corrected_steps, 0U);
}

class LostStepsOfAGantry : public LostSteps {
protected:
    LostStepsOfAGantry() : LostSteps(correcting(gantry(0.8))) {}
};

/// One side has lost steps: it is made up alone, so that the gantry is square before it moves.
TEST_F(LostStepsOfAGantry, AreMadeUpByTheSideThatLostThem) {
    constexpr std::size_t kY2 = 2;
    home();
    ASSERT_EQ(run(program_of({{20, 10}}, 40, {5, 0})).status, ReplyStatus::Accepted);
    wait(0.3);
    vm.device(kY2).plant().push(-20);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_NEAR(slide_mm(kY) - slide_mm(kY2), 0.2, 2 * kHomedWithin_mm);
    finish(program_of({{20, 15}}, 40, {20, 10}));
    EXPECT_NEAR(slide_mm(kY), 15, kHomedWithin_mm);
    EXPECT_NEAR(slide_mm(kY2), 15, kHomedWithin_mm);
    EXPECT_EQ(losses.corrected, (std::vector<std::pair<MotorIndex, std::uint64_t>>{{MotorIndex{kY2}, 20}}));
}

}  // namespace
}  // namespace lockstep
