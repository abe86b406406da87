// A job that waits for a person: why, and what may be done in the pause.
#include <gtest/gtest.h>

#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

constexpr Identity kResumer = 70;

class PauseTest : public Rig {
protected:
    PauseTest() { vm.observe(jobs_); }

    void pause(const Pause& why) {
        home();
        Program program = program_of({{10, 10}}, 40);
        program.blocks.push_back({2, ProgramEvent{ProgramEvent::Kind::OutputOn, 3}});
        program.blocks.push_back({3, why});
        program.blocks.push_back({4, ProgramMove{{20, 5}, 40, false}});
        ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Paused, 5)) << describe();
        wait(0.01);
    }
    Reply resume(bool returns) {
        Command command{.client = kResumer, .sequence = ++sequence_, .kind = CommandKind::Resume, .returns = returns};
        const Reply* reply = nullptr;
        for (int tries = 0; tries < 8 && reply == nullptr; ++tries) {
            vm.send(command);
            wait(0.1);
            for (const Reply& one : vm.replies()) {
                if (one.client == kResumer && one.sequence == sequence_) { reply = &one; }
            }
        }
        return reply == nullptr ? Reply{.status = ReplyStatus::Refused, .text = "no reply"} : *reply;
    }
    /// Jogs X by `mm` to its end.
    Reply jog(double mm) {
        jogger_.press({{.axis = AxisIndex{0}, .speed_mm_s = mm < 0 ? -20.0 : 20.0, .distance_mm = std::abs(mm)}});
        pass(vm, {&jogger_}, Ticks{100'000});
        for (int k = 0; k < 200 && vm.state()->phase != MachinePhase::Paused; ++k) {
            pass(vm, {&jogger_}, Ticks{20'000});
        }
        return jogger_.reply() == nullptr ? Reply{.status = ReplyStatus::Refused, .text = "no reply"}
                                          : *jogger_.reply();
    }

    struct Jobs : VirtualObserver {
        void on_coordinator(std::size_t, Tick, const CoordinatorOutputs& out) override {
            events.insert(events.end(), out.jobs.begin(), out.jobs.end());
            for (const PublishedEvent& event : out.events) { switched_off += event.is_of_program ? 0 : 1; }
        }
        std::vector<std::string> names() const {
            constexpr std::array kNames{"begun", "epoch", "ended", "override", "probe"};
            std::vector<std::string> names;
            for (const JobEvent& event : events) {
                const std::string kind(name_of(event.job_kind));
                if (event.job_kind != JobKind::Home) {
                    names.push_back(kind + " " + kNames[static_cast<std::size_t>(event.kind)]);
                }
            }
            return names;
        }
        std::vector<JobEvent> events;
        int switched_off = 0;
    } jobs_;
    Jogger jogger_{vm};
    std::uint64_t sequence_ = 0;
};

TEST_F(PauseTest, TheStateSaysWhyTheJobWaitsAndWhereItGoesOn) {
    const Pause why{.reason = PauseReason::ToolChange, .tool = 2, .text = "6 mm end mill"};
    pause(why);
    ASSERT_TRUE(vm.state()->pause);
    EXPECT_EQ(vm.state()->pause->why, why);
    EXPECT_EQ(vm.state()->pause->place, (AxisCounts{1000, 1000}));
    ASSERT_EQ(resume(false).status, ReplyStatus::Accepted);
    EXPECT_FALSE(vm.state()->pause) << "it goes on";
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_FALSE(vm.state()->pause);
}

TEST_F(PauseTest, AHoldThatRestsBehindAPartOfTheProgramIsNoWordOfTheProgram) {
    home();
    ASSERT_EQ(run(program_of({{10, 10}}, 40)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Running, 1));
    while (vm.state()->phase == MachinePhase::Running && vm.state()->remaining_s > 0.004) { wait(0.001); }
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 2)) << describe();
    wait(0.01);
    ASSERT_TRUE(vm.state()->pause);
    EXPECT_EQ(vm.state()->pause->why.reason, PauseReason::Hold);
}

TEST_F(PauseTest, AJogInAPauseLeavesTheJobWaiting) {
    pause({});
    const std::uint64_t job = vm.state()->job;
    ASSERT_EQ(jog(3).status, ReplyStatus::Accepted);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Paused);
    EXPECT_EQ(vm.state()->job, job);
    EXPECT_FALSE(vm.state()->outcome);
    ASSERT_TRUE(vm.state()->pause);
    EXPECT_EQ(vm.state()->pause->place, (AxisCounts{1000, 1000}));
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1300, 1000}));
}

TEST_F(PauseTest, GoesOnOnlyFromWhereItPaused) {
    pause({});
    ASSERT_EQ(jog(3).status, ReplyStatus::Accepted);
    const Reply refused = resume(false);
    EXPECT_EQ(refused.status, ReplyStatus::Refused);
    EXPECT_EQ(refused.fault, FaultCode::AwayFromPause);
    EXPECT_NE(refused.text.find("X to 10 mm"), std::string::npos) << refused.text;
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1300, 1000}));
    ASSERT_EQ(jog(-3).status, ReplyStatus::Accepted);
    ASSERT_EQ(resume(false).status, ReplyStatus::Accepted) << "it was jogged back by hand";
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 500}));
}

TEST_F(PauseTest, ReturnsAndThenGoesOn) {
    pause({});
    ASSERT_EQ(jog(3).status, ReplyStatus::Accepted);
    ASSERT_EQ(resume(true).status, ReplyStatus::Accepted);
    EXPECT_TRUE(vm.state()->pause) << "it returns";
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 500}));
    EXPECT_EQ(jobs_.names(),
              (std::vector<std::string>{"run begun", "run epoch", "jog begun", "jog ended", "return begun",
                                        "return epoch", "return ended", "run epoch", "run ended"}));
    EXPECT_EQ(jobs_.switched_off, 0);
}

TEST_F(PauseTest, AHoldOnTheWayBackIsAPauseAgain) {
    pause({});
    ASSERT_EQ(jog(60).status, ReplyStatus::Accepted);
    ASSERT_EQ(resume(true).status, ReplyStatus::Accepted);
    wait(0.3);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 2)) << describe();
    EXPECT_GT(counts()[0], 1000);
    EXPECT_EQ(resume(false).fault, FaultCode::AwayFromPause);
    ASSERT_EQ(jog(1).status, ReplyStatus::Accepted);
    ASSERT_EQ(resume(true).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 9)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 500}));
}

TEST_F(PauseTest, AStopOnTheWayBackEndsTheJob) {
    pause({});
    const std::uint64_t job = vm.state()->job;
    ASSERT_EQ(jog(60).status, ReplyStatus::Accepted);
    ASSERT_EQ(resume(true).status, ReplyStatus::Accepted);
    wait(0.3);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2)) << describe();
    EXPECT_EQ(vm.state()->job, job);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    EXPECT_FALSE(vm.state()->pause);
    ASSERT_EQ(jobs_.names().back(), "run ended");
    home();
    EXPECT_GT(vm.state()->job, job + 2) << "jogs and returns have numbers too";
}

TEST_F(PauseTest, AStopWhileAxesAreJoggedEndsTheJogOnly) {
    pause({});
    jogger_.press({{.axis = AxisIndex{0}, .speed_mm_s = 20, .distance_mm = {}}});
    pass(vm, {&jogger_}, Ticks{300'000});
    ASSERT_EQ(vm.state()->phase, MachinePhase::Jogging);
    EXPECT_TRUE(vm.state()->pause) << "the job still waits";
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 2)) << describe();
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
}

TEST_F(PauseTest, AnEmergencyStopInTheJogOfAPauseEndsTheJob) {
    pause({});
    const std::uint64_t job = vm.state()->job;
    jogger_.press({{.axis = AxisIndex{0}, .speed_mm_s = 20, .distance_mm = {}}});
    pass(vm, {&jogger_}, Ticks{300'000});
    (void)ask(CommandKind::EmergencyStop);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 2)) << describe();
    wait(0.01);
    EXPECT_EQ(vm.state()->job, job);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Failed);
    EXPECT_FALSE(vm.state()->pause);
}

}  // namespace
}  // namespace lockstep
