// A job is begun, interrupted, failed and ended. The test writes the reports of the axes.
#include "coordinator_parts.hpp"
#include "core/coordinator/jobs/inherited_job.hpp"
#include "core/coordinator/jobs/job_advance.hpp"
#include "core/coordinator/jobs/job_commands.hpp"
#include "core/coordinator/jobs/job_report.hpp"
#include "core/coordinator/path/program_frames.hpp"
#include "core/methods/paper_steps.hpp"

namespace lockstep {
namespace {

class Running : public CoordinatorParts {
protected:
    Running() {
        receive_all();
        enter_idle(jobs);
        accept(1, 20, 40);
    }
    template <typename Do>
    auto ask(Do&& what) {
        CoordinatorLoop l = loop();
        return what(l);
    }
    FaultCode run() {
        const CommandResult result =
            ask([&](auto& l) { return commands::run({.kind = CommandKind::Run, .program = 1}, jobs, l); });
        return result ? FaultCode::None : result.error().why;
    }
    void pass_slot() {
        ++slot;
        receive_all();
        ask([&](auto& l) { advance_job(jobs, l); });
    }
    JobLifecycle jobs{machine};
};

TEST_F(Running, BeginsAnEpochAndSendsItsFrames) {
    ASSERT_EQ(run(), FaultCode::None);
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Running);
    EXPECT_TRUE(has_job_event(JobEvent::Kind::Begun));
    EXPECT_TRUE(jobs.activity().is<activity::OnPath>());
    pass_slot();
    EXPECT_TRUE(has_job_event(JobEvent::Kind::EpochBegun));
    for (int i = 0; i < 5 && out.frames.empty(); ++i) { pass_slot(); }
    ASSERT_FALSE(out.frames.empty());
    EXPECT_EQ(out.frames[0].number, 1u);
    EXPECT_EQ(out.frames[0].term, term);
}

TEST_F(Running, RefusesAProgramThatHasNotArrived) {
    const CommandResult result =
        ask([&](auto& l) { return commands::run({.kind = CommandKind::Run, .program = 9}, jobs, l); });
    EXPECT_EQ(result.error().why, FaultCode::UnknownProgram);
    EXPECT_FALSE(jobs.activity().has_job());
}

TEST_F(Running, RefusesAProgramThatEndsBeforeItsEndWithTheLine) {
    const Block too_far{1, ProgramMove{{101, 0}, 20}};
    programs.accept(2, {.name = "far", .axes = {"X", "Y"}, .start_mm = {0, 0}, .blocks = {too_far}});
    const CommandResult result =
        ask([&](auto& l) { return commands::run({.kind = CommandKind::Run, .program = 2}, jobs, l); });
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().why, FaultCode::OutsideTravel);
    EXPECT_TRUE(result.error().text.starts_with("line 1: X 101")) << result.error().text;
}

TEST_F(Running, AProgramThatMovesNothingEndsAtOnce) {
    Program still{.name = "still", .axes = {"X", "Y"}, .start_mm = {0, 0}, .blocks = {}};
    still.blocks.assign(ProgramFrames::kBlocksAtOnce - 1, {1, Dwell{0}});
    programs.accept(1, still);
    ASSERT_EQ(run(), FaultCode::None);
    EXPECT_FALSE(jobs.activity().has_job());
    EXPECT_TRUE(has_job_event(JobEvent::Kind::Ended));
    EXPECT_FALSE(has_job_event(JobEvent::Kind::EpochBegun));
}

TEST_F(Running, AnEventOfAProgramThatMovesNothingIsOfNoEpoch) {
    accept(1, 20, 40);
    ASSERT_EQ(run(), FaultCode::None);
    ask([&](auto& l) { commands::interrupt(Intent::Stop, jobs, l); });
    ask([&](auto& l) { jobs.stand_down(l); });
    enter_idle(jobs);
    const Block event{3, ProgramEvent{.kind = ProgramEvent::Kind::OutputOn, .index = 2}};
    programs.accept(1, {.name = "on", .axes = {"X", "Y"}, .start_mm = {0, 0}, .blocks = {event}});
    ASSERT_EQ(run(), FaultCode::None);
    ASSERT_EQ(out.events.size(), 1u);
    EXPECT_EQ(out.events[0].epoch, 0u) << "no axis moved since this job began";
    EXPECT_EQ(out.events[0].line, 3);
    EXPECT_TRUE(out.events[0].at_rest);
}

TEST_F(Running, AnInterruptionThatNobodyAskedForIsNoticedAndTheJobGoesOn) {
    ASSERT_EQ(run(), FaultCode::None);
    for (int i = 0; i < 6 && out.frames.empty(); ++i) { pass_slot(); }
    ASSERT_FALSE(out.frames.empty());
    const Epoch vetoed = out.frames[0].epoch;
    const auto is_noticed = [this] {
        return std::ranges::count(out.notices, CoordinatorNotice::Kind::Interrupted, &CoordinatorNotice::kind) == 1;
    };
    for (int i = 0; i < 50 && !is_noticed(); ++i) {
        ++slot;
        for (const std::uint32_t axis : {0U, 1U}) {
            AxisState state = state_of(axis);
            state.epoch = vetoed;
            state.veto = 1;
            axes.take(state, slot);
        }
        ask([&](auto& l) { advance_job(jobs, l); });
    }
    EXPECT_TRUE(is_noticed());
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Running);
    EXPECT_TRUE(jobs.activity().is<activity::OnPath>());
}

TEST_F(Running, AFaultInMotionStopsOnThePathBeforeTheMachineIsInFault) {
    ASSERT_EQ(run(), FaultCode::None);
    ask([&](auto& l) { jobs.fail({FaultCode::AxisLost, MotorIndex{1}}, l); });
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Stopping);
    EXPECT_TRUE(jobs.activity().is<activity::OnPath>());
    EXPECT_EQ(jobs.activity().fault().faulty_motor(), 1u);
}

TEST_F(Running, AFaultAtRestEndsInFaultAtOnce) {
    ask([&](auto& l) { jobs.fail({FaultCode::AxisLost, MotorIndex{1}}, l); });
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Fault);
}

TEST_F(Running, AHoldAfterAStopIsRefused) {
    ASSERT_EQ(run(), FaultCode::None);
    EXPECT_TRUE(ask([&](auto& l) { return commands::interrupt(Intent::Stop, jobs, l); }));
    EXPECT_EQ(ask([&](auto& l) { return commands::interrupt(Intent::Hold, jobs, l); }).error().why, FaultCode::Busy);
}

TEST_F(Running, HomingEndsWhenEveryAxisHasDoneItsOrder) {
    EXPECT_TRUE(ask([&](auto& l) { return commands::home({.kind = CommandKind::Home}, jobs, l); }));
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Homing);
    finish_order(0);
    ask([&](auto& l) { advance_job(jobs, l); });
    EXPECT_TRUE(jobs.activity().has_job());
    finish_order(1);
    ask([&](auto& l) { advance_job(jobs, l); });
    EXPECT_FALSE(jobs.activity().has_job());
    EXPECT_TRUE(has_job_event(JobEvent::Kind::Ended));
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Idle);
}

TEST_F(Running, HomingFailsWithTheFaultOfItsAxis) {
    EXPECT_TRUE(ask([&](auto& l) { return commands::home({.kind = CommandKind::Home}, jobs, l); }));
    finish_order(0, FaultCode::HomeSwitchNotFound);
    ask([&](auto& l) { advance_job(jobs, l); });
    EXPECT_EQ(jobs.activity().fault().code, FaultCode::HomeSwitchNotFound);
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Stopping);
    EXPECT_TRUE(orders.is_open(MotorIndex{1}, AxisCommandKind::Halt, axes)) << "the other axis is halted";
}

TEST_F(Running, OwnMovesEndAtTheirTargetsOrInAFault) {
    EXPECT_TRUE(ask([&](auto& l) {
        return commands::move_own({.kind = CommandKind::MoveOwn, .program = 1}, methods::begin_steps, jobs, l);
    }));
    EXPECT_FALSE(ask([&](auto& l) { return commands::interrupt(Intent::Hold, jobs, l); })) << "they cannot be resumed";
    finish_order(0);
    finish_order(1);  // both are still at 0, which is not their target
    ask([&](auto& l) { advance_job(jobs, l); });
    EXPECT_EQ(jobs.activity().fault().code, FaultCode::PositionMismatch);
}

TEST_F(Running, StandingDownForgetsTheJobWithoutARecord) {
    ASSERT_EQ(run(), FaultCode::None);
    ask([&](auto& l) { jobs.stand_down(l); });
    EXPECT_FALSE(jobs.activity().has_job());
    EXPECT_FALSE(jobs.activity().in_motion());
    MachineState state;
    report_job(jobs, state, loop());
    EXPECT_EQ(state.outcome, JobOutcome::Stopped);
}

TEST_F(Running, StandingDownEndsAPauseAndAJogInIt) {
    programs.accept(1, {.name = "pause", .axes = {"X", "Y"}, .start_mm = {0, 0}, .blocks = {{1, Pause{}}}});
    const Command jog{
        .client = 4, .sequence = 1, .kind = CommandKind::Jog, .jogs = {{.axis = AxisIndex{0}, .speed_mm_s = 5}}};
    for (const bool is_jogged : {false, true}) {
        ASSERT_EQ(run(), FaultCode::None);
        EXPECT_EQ(jobs.activity().phase(), MachinePhase::Paused);
        if (is_jogged) {
            EXPECT_TRUE(ask([&](auto& l) { return commands::jog(jog, jobs, l); }));
            EXPECT_EQ(jobs.activity().phase(), MachinePhase::Jogging);
        }
        ask([&](auto& l) { jobs.stand_down(l); });
        EXPECT_EQ(jobs.activity().phase(), MachinePhase::Standby);
        EXPECT_FALSE(jobs.activity().has_job());
        EXPECT_EQ(jobs.count().outcome(), JobOutcome::Stopped);
        enter_idle(jobs);
    }
}

class RunningByLai : public CoordinatorParts {
protected:
    RunningByLai() {
        receive_all();
        enter_idle(jobs);
    }
    static const MachineConfig& by_lai(MachineConfig& machine) {
        machine.coordination = StepMethod::Lai;
        return machine;
    }
    CommandResult run(double feed_mm_s) {
        programs.accept(1, {.name = "slow",
                            .axes = {"X", "Y"},
                            .start_mm = {0, 0},
                            .blocks = {{4, ProgramMove{{10, 10}, 20}}, {5, ProgramMove{{20, 10}, feed_mm_s}}}});
        CoordinatorLoop l = loop();
        return commands::run({.kind = CommandKind::Run, .program = 1}, jobs, l);
    }
    JobLifecycle jobs{by_lai(machine)};
};

TEST_F(RunningByLai, RefusesAMoveThatIsTooSlowWithItsLine) {
    const CommandResult result = run(1);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().why, FaultCode::BadProgram);
    EXPECT_TRUE(result.error().text.starts_with("line 5: ")) << result.error().text;
    EXPECT_FALSE(jobs.activity().has_job());
}

TEST_F(RunningByLai, RunsMovesOfAtLeastAPulsePerPeriod) {
    EXPECT_TRUE(run(20));
    EXPECT_TRUE(jobs.activity().is<activity::OnPath>());
}

}  // namespace
}  // namespace lockstep
