// Two coordinators: one owns the machine, the other stands by. At most one ever moves it.
#include <map>
#include <set>

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using Kind = VirtualFault::Kind;

/// The runs of each axis with their owners, and each coordinator's notices.
class Owners : public VirtualObserver {
public:
    void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
        for (const CoordinatorNotice& notice : out.notices) {
            claims += notice.kind == CoordinatorNotice::Kind::Claimed ? 1 : 0;
            stood_down += notice.kind == CoordinatorNotice::Kind::StoodDown ? 1 : 0;
        }
        for (const JobEvent& job : out.jobs) { epochs += job.kind == JobEvent::Kind::EpochBegun ? 1 : 0; }
        for (const Frame& frame : out.frames) { senders[frame.epoch].insert(frame.term); }
    }
    void on_axis(MotorIndex axis, Tick /*now*/, const AxisOutputs& out, AxisNode& /*node*/) override {
        for (const ExecutedTrack& track : out.tracks) {
            if (track.epoch == 0 || track.tail) { continue; }
            EXPECT_TRUE(ran[axis].insert({track.epoch, track.frame}).second) << "a frame was run twice";
        }
    }
    void expect_one_writer_each() const {
        for (const auto& [epoch, terms] : senders) { EXPECT_EQ(terms.size(), 1u) << "epoch " << epoch; }
    }
    int claims = 0;
    int stood_down = 0;
    int epochs = 0;
    std::map<Epoch, std::set<Term>> senders;
    std::map<std::size_t, std::set<std::pair<Epoch, FrameNumber>>> ran;
};

/// Axes X (process 0) and Y (1), the coordinators (2, 3). Slots of 1 ms; silence is 16 slots.
class Standby : public Rig {
protected:
    explicit Standby(OnTakeover on_takeover = OnTakeover::Stop)
        : Rig({.machine = small_machine(), .on_takeover = on_takeover, .coordinators = 2}) {
        vm.observe(owners);
    }
    void TearDown() override { owners.expect_one_writer_each(); }

    static Ticks ticks(double seconds) { return {static_cast<std::int64_t>(seconds * 1e6)}; }
    /// Determines the owner and the standby. Both may have claimed the machine at first, because they began together.
    void settle() {
        home();
        owner = vm.owner().value();
        other = owner == 2 ? 3 : 2;
        term = vm.state()->term;
        owners.claims = owners.stood_down = 0;
    }
    void start_job() {
        settle();
        ASSERT_EQ(run(program_of({{85, 45}, {20, 60}}, 40)).status, ReplyStatus::Accepted);
        wait(0.8);
    }
    void inject(Kind kind, std::size_t process, double seconds, std::optional<std::size_t> peer = {}) {
        vm.schedule({.kind = kind, .process = process, .at = vm.now(), .lasts = ticks(seconds), .peer = peer});
    }
    bool taken_over() {
        return vm.advance_until([&] { return vm.owner() == other && idle(); }, ticks(12));
    }
    bool idle() const { return vm.state()->term > term && vm.state()->phase == MachinePhase::Idle; }
    void expect_moves_without_homing() {
        const auto at = counts();
        const std::vector<double> from{static_cast<double>(at[0]) / 100, static_cast<double>(at[1]) / 100};
        const Reply reply = run(program_of({{20, 10}}, 40, from));
        ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text << "; " << describe();
        ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000}));
    }

    Owners owners;
    std::size_t owner = 0;
    std::size_t other = 0;
    Term term;
};

TEST_F(Standby, TakesOverAtRestWhenTheOwnerEnds) {
    start_job();
    inject(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over()) << describe();
    EXPECT_EQ(fault(), FaultCode::None);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped) << "the job is at its end";
    EXPECT_NEAR(static_cast<double>(counts()[0] - 500) / 2, static_cast<double>(counts()[1] - 500), 1) << "on the path";
    expect_moves_without_homing();
}

TEST_F(Standby, KeepsTheOverridesOfTheOwnerBefore) {
    settle();
    ASSERT_EQ(vm.state()->overrides, Overrides{});
    const auto asked = vm.set_overrides({50, 25});
    wait(0.1);
    ASSERT_EQ(vm.reply_to(asked)->status, ReplyStatus::Accepted);
    inject(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over());
    EXPECT_EQ(vm.state()->overrides, (Overrides{50, 25}));
}

TEST_F(Standby, NumbersJobsOnFromThoseOfTheOwnerBefore) {
    start_job();
    const auto job = vm.state()->job;
    inject(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over());
    EXPECT_EQ(vm.state()->job, job);
    expect_moves_without_homing();
    EXPECT_EQ(vm.state()->job, job + 1);
}

TEST_F(Standby, AnOwnerThatStalledForLongMovesNothingAndGivesUpTheMachine) {
    start_job();
    inject(Kind::Freeze, owner, 2);
    ASSERT_TRUE(taken_over()) << describe();
    const auto at = counts();
    owners.epochs = 0;
    wait(2.5);
    EXPECT_EQ(owners.epochs, 0) << "it queries the axes first";
    EXPECT_EQ(owners.stood_down, 1);
    EXPECT_EQ(counts(), at);
    EXPECT_EQ(vm.owner(), other);
    expect_moves_without_homing();
}

/// After a stall the network may need a while to discover the axes again. The owner receives them only when it would
/// already regard them as lost.
class Woken : public Standby, public testing::WithParamInterface<int> {};

TEST_P(Woken, AnOwnerMovesNothingBeforeItReceivedEveryAxisTwice) {
    start_job();
    inject(Kind::Freeze, owner, 2);
    vm.schedule({.kind = Kind::Cut, .process = owner, .at = vm.now(), .lasts = ticks(2 + 0.001 * GetParam())});
    ASSERT_TRUE(taken_over()) << describe();
    owners.epochs = 0;
    wait(2.5);
    EXPECT_EQ(owners.epochs, 0);
    EXPECT_EQ(owners.stood_down, 1);
    expect_moves_without_homing();
}

INSTANTIATE_TEST_SUITE_P(AfterSilence, Woken, testing::Range(12, 22));

TEST_F(Standby, AnOwnerThatStalledInItsOwnMovesOrdersNothingMore) {
    settle();
    vm.give_program(7, program_of({{90, 90}}, 40));
    ASSERT_EQ(ask(CommandKind::MoveOwn, {}, 7).status, ReplyStatus::Accepted);
    wait(0.05);
    inject(Kind::Freeze, owner, 6);
    ASSERT_TRUE(
        vm.advance_until([&] { return vm.owner() == other && vm.state()->phase == MachinePhase::Fault; }, ticks(3)))
        << describe();
    EXPECT_EQ(fault(), FaultCode::CoordinatorSilent) << "the axes halted, so the other could take over";
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(taken_over()) << describe();
    expect_moves_without_homing();
    wait(6);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000}));
}

TEST_F(Standby, DoesNothingIfOnlyItDoesNotReceiveTheOwner) {
    start_job();
    inject(Kind::Cut, other, 4, owner);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    wait(1);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
    EXPECT_EQ(owners.claims, 0);
}

TEST_F(Standby, CutOffFromAllClaimsInVainAndGivesUp) {
    start_job();
    inject(Kind::Cut, other, 0.5);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    wait(0.5);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
    EXPECT_EQ(vm.owner(), owner);
    expect_moves_without_homing();
}

TEST_F(Standby, TakesOverFromAnOwnerThatIsCutOff) {
    start_job();
    inject(Kind::Cut, owner, 1.5);
    ASSERT_TRUE(vm.advance_until([&] { return owners.claims > 0 && idle(); }, ticks(3))) << describe();
    wait(2);
    EXPECT_EQ(owners.stood_down, 1) << "when it receives again";
    EXPECT_EQ(vm.owner(), other);
    expect_moves_without_homing();
}

TEST_F(Standby, TakesOverFromAnOwnerThatNoPeerReceives) {
    start_job();
    vm.schedule({.kind = Kind::Cut, .process = owner, .at = vm.now(), .lasts = ticks(60), .incoming = false});
    ASSERT_TRUE(vm.advance_until([&] { return owners.stood_down == 1 && idle(); }, ticks(3)))
        << "it receives the axes' states, with the owner that they follow";
    expect_moves_without_homing();
}

/// X receives only the first coordinator, Y only the second: neither has both axes, so nothing can move.
TEST_F(Standby, NoCoordinatorMovesAMachineWhoseAxesAreSplit) {
    settle();
    const auto at = counts();
    inject(Kind::Cut, 1, 2, owner);
    inject(Kind::Cut, 0, 2, other);
    inject(Kind::Cut, owner, 2, other);
    wait(1);
    EXPECT_EQ(run(program_of({{20, 10}}, 40)).status, ReplyStatus::Refused);
    wait(2);
    EXPECT_EQ(counts(), at);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 5) || vm.state()->phase == MachinePhase::Idle) << describe();
    (void)ask(CommandKind::Reset);
    wait(0.1);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    expect_moves_without_homing();
}

TEST_F(Standby, ARestartedOneStandsByAndTakesOverLater) {
    start_job();
    inject(Kind::Crash, owner, 0.5);
    ASSERT_TRUE(taken_over());
    wait(1);
    EXPECT_EQ(vm.owner(), other) << "it restarts as the standby";
    std::swap(owner, other);
    term = vm.state()->term;
    inject(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over()) << describe();
    expect_moves_without_homing();
}

TEST_F(Standby, DoesNotExecuteACommandThatTheOwnerMayHaveBegun) {
    settle();
    vm.give_program(7, program_of({{90, 90}}, 40));
    const auto asked = vm.command(CommandKind::Run, {}, 7);
    wait(0.01);
    inject(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over());
    const auto at = counts();
    vm.repeat_command();
    wait(0.1);
    const Reply* last = &vm.replies().back();
    EXPECT_EQ(last->sequence, asked);
    EXPECT_EQ(last->fault, FaultCode::CoordinatorChanged);
    wait(0.5);
    EXPECT_EQ(counts(), at);
}

/// The axes stop without a coordinator. A coordinator that takes over must not refuse to report the stop.
TEST_F(Standby, TakesAnEmergencyStopThatTheOwnerNeverAnswered) {
    start_job();
    inject(Kind::Crash, owner, 100);
    wait(0.001);
    const auto asked = vm.command(CommandKind::EmergencyStop);
    ASSERT_TRUE(vm.advance_until([&] { return vm.owner() == other && vm.state()->term > term; }, ticks(3)));
    vm.repeat_command();
    wait(0.1);
    ASSERT_NE(vm.reply_to(asked), nullptr);
    EXPECT_EQ(vm.reply_to(asked)->status, ReplyStatus::Accepted) << vm.reply_to(asked)->text;
    EXPECT_EQ(fault(), FaultCode::EmergencyStopped);
}

/// A coordinator that takes over continues the job.
class Continue : public Standby {
protected:
    Continue() : Standby(OnTakeover::Continue) {
        vm.observe(steps);
        vm.observe(doubts);
    }
    static Program there_and_back() { return program_of({{85, 45}, {20, 60}, {20, 60}, {30, 20}}, 40); }

    /// Runs a job from its first step to its end. The owner ends after `seconds`.
    void run_with_crash_after(double seconds) {
        settle();
        steps.steps.clear();
        ASSERT_EQ(run(there_and_back()).status, ReplyStatus::Accepted);
        wait(seconds);
        inject(Kind::Crash, owner, 100);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
    }
    /// The steps of each axis in their order, without their times: the path.
    std::vector<std::vector<int>> path() const {
        std::vector<std::vector<int>> path(2);
        for (const StepLog::Step& step : steps.steps) { path[step.axis].push_back(step.direction); }
        return path;
    }

    class Doubts : public VirtualObserver {
    public:
        void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
            for (const CoordinatorNotice& notice : out.notices) {
                if (notice.kind == CoordinatorNotice::Kind::JobCutShort) { cut.push_back(notice.doubt); }
                continued += notice.kind == CoordinatorNotice::Kind::JobContinued ? 1 : 0;
            }
        }
        std::vector<TakeoverDoubt> cut;
        int continued = 0;
    };
    StepLog steps;
    Doubts doubts;
};

TEST_F(Continue, ContinuesTheJobToItsEndAsTheSameJob) {
    start_job();
    const auto job = vm.state()->job;
    inject(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over()) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(vm.state()->job, job);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
    EXPECT_EQ(doubts.continued, 1);
    EXPECT_TRUE(doubts.cut.empty());
    expect_moves_without_homing();
}

TEST_F(Continue, StopsIfACommandRequestedItMeanwhile) {
    start_job();
    inject(Kind::Crash, owner, 100);
    wait(0.002);
    (void)vm.command(CommandKind::Hold);
    ASSERT_TRUE(taken_over()) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    EXPECT_EQ(doubts.cut, std::vector{TakeoverDoubt::Interrupted});
}

TEST_F(Continue, StopsAJobThatWasHeld) {
    start_job();
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3));
    inject(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over()) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    EXPECT_EQ(doubts.cut, std::vector{TakeoverDoubt::NotRunning});
}

TEST_F(Continue, StopsIfAnAxisRestarted) {
    start_job();
    inject(Kind::Crash, owner, 100);
    inject(Kind::Crash, 1, 0.01);
    ASSERT_TRUE(taken_over()) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    ASSERT_EQ(doubts.cut.size(), 1u);
    EXPECT_EQ(doubts.continued, 0);
}

TEST_F(Continue, CanBeStoppedAndHeldLikeAnyOther) {
    start_job();
    inject(Kind::Crash, owner, 100);
    ASSERT_TRUE(vm.advance_until([&] { return doubts.continued == 1; }, ticks(3)));
    wait(0.3);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(vm.advance_until([&] { return vm.state()->phase == MachinePhase::Holding; }, ticks(3)));
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    wait(0.1);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(vm.advance_until([&] { return vm.state()->phase == MachinePhase::Idle; }, ticks(3)));
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
}

TEST_F(Continue, AnOwnerThatStalledForLongLeavesTheJobToTheOther) {
    start_job();
    inject(Kind::Freeze, owner, 1.5);
    ASSERT_TRUE(taken_over()) << describe();
    wait(2);
    EXPECT_EQ(owners.stood_down, 1);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
    expect_moves_without_homing();
}

/// X receives only the first coordinator, Y only the second: the job stands still until the network is repaired.
TEST_F(Continue, NoCoordinatorContinuesOnAMachineWhoseAxesAreSplit) {
    start_job();
    inject(Kind::Cut, 1, 2, owner);
    inject(Kind::Cut, 0, 2, other);
    inject(Kind::Cut, owner, 2, other);
    wait(1.5);
    const auto at = counts();
    wait(0.4);
    EXPECT_EQ(counts(), at);
    EXPECT_EQ(doubts.continued, 0);
}

/// Runs the same job on the same machine. The owner ends at an instant of the job, or never.
class ContinueAt : public Continue, public testing::WithParamInterface<int> {};

TEST_P(ContinueAt, AnyInstantEndsAtTheSamePlaceOnTheSamePath) {
    run_with_crash_after(0.001 * GetParam());
    const bool is_undisturbed = GetParam() == 20'000;
    EXPECT_EQ(doubts.continued, is_undisturbed ? 0 : 1);
    EXPECT_TRUE(doubts.cut.empty());
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{3000, 2000}));
    std::vector<std::vector<int>> expected(2);
    const auto run_of = [&](std::size_t axis, int from, int to) {
        expected[axis].insert(expected[axis].end(), static_cast<std::size_t>(std::abs(to - from)), to > from ? 1 : -1);
    };
    run_of(0, 500, 8500), run_of(0, 8500, 2000), run_of(0, 2000, 3000);
    run_of(1, 500, 4500), run_of(1, 4500, 6000), run_of(1, 6000, 2000);
    EXPECT_EQ(path(), expected) << "each step once, none back and forth";
}

INSTANTIATE_TEST_SUITE_P(Slots, ContinueAt, testing::Range(3, 60, 3));
INSTANTIATE_TEST_SUITE_P(Job, ContinueAt, testing::Range(100, 5000, 217));

}  // namespace
}  // namespace lockstep
