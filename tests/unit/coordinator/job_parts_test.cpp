// The parts of a job: its number and outcome, groups of homing, targets of own moves, progress on a path.
#include <gtest/gtest.h>

#include "coordinator_parts.hpp"
#include "core/coordinator/homing/homing_sequence.hpp"
#include "core/coordinator/jobs/inherited_job.hpp"
#include "core/coordinator/jobs/job.hpp"
#include "core/coordinator/jobs/job_commands.hpp"
#include "core/coordinator/jobs/own_targets.hpp"
#include "core/coordinator/jobs/path_progress.hpp"
#include "core/coordinator/jobs/path_task.hpp"
#include "core/methods/paper_steps.hpp"

namespace lockstep {
namespace {

TEST(JobCount, ReportsTheLineOnlyOfTheJobThatATakeoverEnded) {
    JobCount log;
    EXPECT_EQ(log.begin({5, 1}), 1u);
    log.cut(17);
    EXPECT_EQ(log.line(), 17);
    EXPECT_EQ(log.outcome(), JobOutcome::Stopped);
    EXPECT_EQ(log.begin({6, 1}), 2u);
    EXPECT_FALSE(log.line());
    EXPECT_EQ(log.begun_in(), (Term{6, 1}));
}

TEST(JobCount, SaysWhyAProgramEndedBeforeItsEndUntilTheNextJobBegins) {
    JobCount log;
    (void)log.begin({5, 1});
    log.cut(17, FaultCode::SenderSilent);
    EXPECT_EQ(log.fault(), FaultCode::SenderSilent);
    (void)log.begin({5, 1});
    EXPECT_EQ(log.fault(), FaultCode::None);
}

TEST(JobCount, GoesOnCountingFromTheOwnerBefore) {
    JobCount log;
    log.inherit({.job = 8, .outcome = JobOutcome::Done, .job_begun = {4, 4}});
    EXPECT_EQ(log.number(), 8u);
    EXPECT_EQ(log.outcome(), JobOutcome::Done);
    EXPECT_EQ(log.begin({5, 1}), 9u);
}

TEST(HomingSequence, HomesAxesOfOneSequenceTogetherTheLowestFirst) {
    MachineConfig machine{.name = "five"};
    for (const int sequence : {2, 1, 2, 1, 3}) {
        machine.axes.push_back({.name = "A"});
        machine.axes.back().homing.sequence = sequence;
    }
    HomingSequence homing(AxisSet::first(4));
    EXPECT_EQ(homing.next_group(machine).bits(), 0b01010u);
    EXPECT_EQ(homing.next_group(machine).bits(), 0b00101u);
    EXPECT_EQ(homing.next_group(machine).bits(), 0u) << "the last axis was not asked for";
}

TEST(PathProgress, AddsUpToTheShareOfThePlannedTime) {
    PathProgress progress;
    progress.note(subticks(Ticks{250}), subticks(Ticks{750}));
    EXPECT_DOUBLE_EQ(progress.share(), 0.25);
    progress.note(subticks(Ticks{500}), subticks(Ticks{500}));
    EXPECT_DOUBLE_EQ(progress.share(), 0.5);
}

TEST(PathProgress, NeverFallsWhenWhatIsLeftIsPlannedAnew) {
    PathProgress progress;
    progress.note(subticks(Ticks{500}), subticks(Ticks{500}));
    progress.end_path(subticks(Ticks{400}));
    progress.note({}, subticks(Ticks{2000}));
    EXPECT_DOUBLE_EQ(progress.share(), 0.5);
    progress.note(subticks(Ticks{1100}), subticks(Ticks{1000}));
    EXPECT_DOUBLE_EQ(progress.share(), 0.75);
}

class OwnTargetsOfTwo : public CoordinatorParts {
protected:
    OwnTargetsOfTwo() { receive_all(); }
    std::expected<OwnTargets, Refusal> targets(double x_mm, double y_mm, std::optional<Ticks> ticks = {}) {
        accept(1, x_mm, y_mm);
        return OwnTargets::plan(*programs.find(1), ticks, loop(), methods::begin_steps);
    }
};

TEST_F(OwnTargetsOfTwo, OrderOnlyTheAxesThatMove) {
    const auto to = targets(0, 30);
    ASSERT_TRUE(to);
    EXPECT_EQ(to->motors(), MotorSet{MotorIndex{1}});
    to->order(orders, term);
    EXPECT_FALSE(orders.newest(MotorIndex{0}));
    EXPECT_EQ(orders.newest(MotorIndex{1})->target_steps, 3000);
}

TEST_F(OwnTargetsOfTwo, ProgressIsThatOfTheAxisWithTheMostBeforeIt) {
    const auto to = targets(20, 40);
    AxisState x = state_of(0);
    x.position = Position::steps(2000);
    axes.take(x, slot);
    AxisState y = state_of(1);
    y.position = Position::steps(1000);
    axes.take(y, slot);
    EXPECT_DOUBLE_EQ(to->progress(axes), 0.25);
}

TEST_F(OwnTargetsOfTwo, RefuseAnAxisThatIsNotHomedAndATimeThatIsTooShort) {
    EXPECT_EQ(targets(20, 40, Ticks{10}).error().why, FaultCode::BadProgram);
    AxisState y = state_of(1);
    y.homed = false;
    axes.take(y, slot);
    EXPECT_EQ(targets(20, 40).error().why, FaultCode::NotHomed);
}

TEST_F(OwnTargetsOfTwo, LastAsLongAsAskedOrAsTheSlowestAxisTakes) {
    const Tick begun = loop().now;
    const auto asked = targets(20, 40, Ticks{3'000'000});
    EXPECT_DOUBLE_EQ(asked->remaining_s(begun, machine), 3);
    EXPECT_DOUBLE_EQ(asked->remaining_s(begun + Ticks{1'000'000}, machine), 2);
    EXPECT_EQ(asked->remaining_s(begun + Ticks{6'000'000}, machine), 0);
    const double fastest_s = 40.0 / 50;  // of Y, at its greatest velocity all the way
    EXPECT_NEAR(targets(20, 40)->remaining_s(loop().now, machine), fastest_s, 0.15);
    EXPECT_GT(targets(20, 40)->remaining_s(loop().now, machine), fastest_s);
}

class Inherited : public CoordinatorParts {
protected:
    Inherited() {
        receive_all();
        accept(1, 20, 40);
        last.job = 5;
        last.job_kind = JobKind::Run;
        last.line = 8;
        last.program = 1;
        last.config_hash = 1;
        last.stamp = slot;
    }
    /// Takes the job of `state` over. Returns why it is not kept.
    std::optional<TakeoverDoubt> doubt_of(const MachineState& state, OnTakeover on_takeover = OnTakeover::Continue,
                                          std::optional<Slot> interrupted = {}) {
        JobLifecycle jobs(machine);
        jobs.activity().as<activity::Standby>()->interrupted = interrupted;
        CoordinatorLoop l = loop();
        Inheritance(on_takeover, 1).take_over(state, jobs, l);
        EXPECT_EQ(jobs.activity().phase(), MachinePhase::Waiting);
        const auto cut = std::ranges::find(out.notices, CoordinatorNotice::Kind::JobCutShort, &CoordinatorNotice::kind);
        EXPECT_EQ(jobs.activity().has_job(), cut == out.notices.end());
        return cut == out.notices.end() ? std::nullopt : std::optional(cut->doubt);
    }
    MachineState last;
};

TEST_F(Inherited, IsNotGoneOnWithUnlessAskedFor) {
    EXPECT_EQ(doubt_of(last, OnTakeover::Stop), TakeoverDoubt::NotAsked);
    EXPECT_EQ(doubt_of(last, OnTakeover::Continue), std::nullopt);
}

TEST_F(Inherited, NamesWhyItIsNotGoneOnWith) {
    MachineState other = last;
    other.program.reset();
    EXPECT_EQ(doubt_of(other), TakeoverDoubt::NotRunning);
    other.program = 2;
    EXPECT_EQ(doubt_of(other), TakeoverDoubt::UnknownProgram);
    other = last;
    other.config_hash = 2;
    EXPECT_EQ(doubt_of(other), TakeoverDoubt::OtherPlan);
    EXPECT_EQ(doubt_of(last, OnTakeover::Continue, slot), TakeoverDoubt::Interrupted);
    axes.forget(MotorIndex{1});
    EXPECT_EQ(doubt_of(last), TakeoverDoubt::AxisInDoubt);
}

TEST_F(Inherited, AJobThatEndedIsNotTakenOver) {
    last.outcome = JobOutcome::Done;
    JobLifecycle jobs(machine);
    CoordinatorLoop l = loop();
    Inheritance(OnTakeover::Continue, 1).take_over(last, jobs, l);
    EXPECT_FALSE(jobs.activity().has_job());
    EXPECT_EQ(jobs.count().number(), 5u);
    EXPECT_EQ(jobs.count().outcome(), JobOutcome::Done);
}

/// The program may be read back from a file, which takes some loops.
TEST_F(Inherited, NothingElseBeginsBeforeItsProgramIsAtHand) {
    programs.accept(1, {.name = "none", .axes = {"X", "Y"}, .start_mm = {0, 0}, .blocks = {}});
    last.rests = {{.frame = 0}};
    JobLifecycle jobs(machine);
    CoordinatorLoop l = loop();
    Inheritance(OnTakeover::Continue, 1).take_over(last, jobs, l);
    ASSERT_TRUE(jobs.activity().has_job());
    EXPECT_EQ(commands::run({.kind = CommandKind::Run, .program = 1}, jobs, l).error().why, FaultCode::NotReady);
}

TEST_F(CoordinatorParts, AJobThatIsContinuedRemembersWhichEventsWerePublished) {
    JobLifecycle jobs(machine);
    accept(1, 20, 40);
    PathTask task{.job = {.number = 3, .program = programs.find(1)}};
    const JobRest rest{.done = LegEnd{.block = 1}};
    (void)jobs.path().continue_rest(task, rest, 7, loop(), out.events);
    EXPECT_EQ(jobs.path().events().from(), 7u);
    enter_idle(jobs);
    receive_all();
    CoordinatorLoop l = loop();
    ASSERT_TRUE(commands::run({.kind = CommandKind::Run, .program = 1}, jobs, l));
    EXPECT_EQ(jobs.path().events().from(), 0u);
}

TEST_F(CoordinatorParts, AJobThatIsContinuedBehindItsLastMoveIsDone) {
    JobLifecycle jobs(machine);
    jobs.activity().become(MachineEvent::Claimed, activity::Waiting{}, out);
    accept(1, 20, 40);
    receive_all();
    CoordinatorLoop l = loop();
    PathTask task{.job = {.number = 3, .program = programs.find(1)}};
    const PathNext next = jobs.path().continue_rest(task, {.done = LegEnd{.block = 1}}, 0, l, out.events);
    jobs.follow(task, next, {}, l);
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Idle);
    EXPECT_EQ(jobs.count().outcome(), JobOutcome::Done);
}

TEST_F(CoordinatorParts, AJobThatIsContinuedBeforeAPausePauses) {
    JobLifecycle jobs(machine);
    jobs.activity().become(MachineEvent::Claimed, activity::Waiting{}, out);
    const std::vector<Block> blocks{{1, ProgramMove{{20, 40}, 20}}, {2, Pause{}}};
    programs.accept(1, {.name = "pause", .axes = {"X", "Y"}, .start_mm = {0, 0}, .blocks = blocks});
    receive_all();
    CoordinatorLoop l = loop();
    PathTask task{.job = {.number = 3, .program = programs.find(1)}};
    const LegEnd end{.kind = LegEnd::Kind::Pause, .block = 1};
    const PathNext next = jobs.path().continue_rest(task, {.done = end}, 0, l, out.events);
    jobs.follow(task, next, {}, l);
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Paused);
}

/// A hold before the first frame was requested, so it says nothing about the path.
TEST(PathTask, IsGivenUpAfterInterruptionsWithoutAFrameAndNotAfterHolds) {
    PathTask task;
    const EpochEnd fruitless{.kind = EpochEnd::Kind::Interrupted};
    for (int k = 0; k < 5; ++k) { task.interrupt(fruitless); }
    EXPECT_TRUE(task.may_try_again(fruitless));
    EXPECT_TRUE(task.may_try_again(fruitless));
    EXPECT_FALSE(task.may_try_again(fruitless));
    task.interrupt({.kind = EpochEnd::Kind::Interrupted, .ran = 1});
    EXPECT_TRUE(task.may_try_again(fruitless)) << "a frame was run";
}

}  // namespace
}  // namespace lockstep
