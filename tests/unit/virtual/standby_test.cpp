// Two coordinators: one owns the machine, the other stands by. At most one ever moves it.
#include <map>
#include <set>

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using Kind = VirtualFault::Kind;

/// What each axis ran, of whom, and what each coordinator said of itself.
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
    void on_axis(std::size_t axis, Tick /*now*/, const AxisOutputs& out, AxisNode& /*node*/) override {
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
    Standby() : Rig({.machine = small_machine(), .coordinators = 2}) { vm.observe(owners); }
    void TearDown() override { owners.expect_one_writer_each(); }

    static Ticks ticks(double seconds) { return {static_cast<std::int64_t>(seconds * 1e6)}; }
    /// Who owns the machine, and who stands by. Both may have claimed it at first: they began together.
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
    void befall(Kind kind, std::size_t process, double seconds, std::optional<std::size_t> peer = {}) {
        vm.schedule({.kind = kind, .process = process, .at = vm.now(), .lasts = ticks(seconds), .peer = peer});
    }
    bool taken_over() {
        return vm.advance_until([&] { return vm.owner() == other && idle(); }, ticks(3));
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
    befall(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over()) << describe();
    EXPECT_EQ(fault(), FaultCode::None);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped) << "the job is at its end";
    EXPECT_NEAR(static_cast<double>(counts()[0] - 500) / 2, static_cast<double>(counts()[1] - 500), 1) << "on the path";
    expect_moves_without_homing();
}

TEST_F(Standby, KeepsTheOverridesThatSomebodyTurned) {
    settle();
    ASSERT_EQ(vm.state()->overrides, Overrides{});
    const auto asked = vm.turn({50, 25});
    wait(0.1);
    ASSERT_EQ(vm.reply_to(asked)->status, ReplyStatus::Accepted);
    befall(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over());
    EXPECT_EQ(vm.state()->overrides, (Overrides{50, 25}));
}

TEST_F(Standby, NumbersJobsOnFromThoseOfTheOwnerBefore) {
    start_job();
    const auto job = vm.state()->job;
    befall(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over());
    EXPECT_EQ(vm.state()->job, job);
    expect_moves_without_homing();
    EXPECT_EQ(vm.state()->job, job + 1);
}

TEST_F(Standby, AnOwnerThatWakesUpLateMovesNothingAndStandsDown) {
    start_job();
    befall(Kind::Freeze, owner, 2);
    ASSERT_TRUE(taken_over()) << describe();
    const auto at = counts();
    owners.epochs = 0;
    wait(2.5);
    EXPECT_EQ(owners.epochs, 0) << "it asks the axes first";
    EXPECT_EQ(owners.stood_down, 1);
    EXPECT_EQ(counts(), at);
    EXPECT_EQ(vm.owner(), other);
    expect_moves_without_homing();
}

TEST_F(Standby, AnOwnerThatStalledInItsOwnMovesOrdersNothingMore) {
    settle();
    vm.give_program(7, program_of({{90, 90}}, 40));
    ASSERT_EQ(ask(CommandKind::MoveOwn, 0, 7).status, ReplyStatus::Accepted);
    wait(0.05);
    befall(Kind::Freeze, owner, 6);
    wait(0.5);
    EXPECT_EQ(vm.owner(), owner) << "nobody takes over while an axis moves";
    ASSERT_TRUE(taken_over()) << describe();
    expect_moves_without_homing();
    wait(6);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000}));
}

TEST_F(Standby, DoesNothingWhileItAloneDoesNotHearTheOwner) {
    start_job();
    befall(Kind::Cut, other, 4, owner);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    wait(1);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
    EXPECT_EQ(owners.claims, 0);
}

TEST_F(Standby, CutOffFromAllClaimsInVainAndGivesWay) {
    start_job();
    befall(Kind::Cut, other, 0.5);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    wait(0.5);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
    EXPECT_EQ(vm.owner(), owner);
    expect_moves_without_homing();
}

TEST_F(Standby, TakesOverFromAnOwnerThatIsCutOff) {
    start_job();
    befall(Kind::Cut, owner, 1.5);
    ASSERT_TRUE(vm.advance_until([&] { return owners.claims > 0 && idle(); }, ticks(3))) << describe();
    wait(2);
    EXPECT_EQ(owners.stood_down, 1) << "when it hears again";
    EXPECT_EQ(vm.owner(), other);
    expect_moves_without_homing();
}

TEST_F(Standby, TakesOverFromAnOwnerThatIsHeardByNobody) {
    start_job();
    vm.schedule({.kind = Kind::Cut, .process = owner, .at = vm.now(), .lasts = ticks(60), .incoming = false});
    ASSERT_TRUE(vm.advance_until([&] { return owners.stood_down == 1 && idle(); }, ticks(3)))
        << "it hears whom the axes follow";
    expect_moves_without_homing();
}

/// X hears only the first coordinator, Y only the second: nobody has both axes, so nothing can move.
TEST_F(Standby, NobodyMovesAMachineWhoseAxesAreSplit) {
    settle();
    const auto at = counts();
    befall(Kind::Cut, 1, 2, owner);
    befall(Kind::Cut, 0, 2, other);
    befall(Kind::Cut, owner, 2, other);
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

TEST_F(Standby, WhoComesBackStandsByAndTakesOverInItsTurn) {
    start_job();
    befall(Kind::Crash, owner, 0.5);
    ASSERT_TRUE(taken_over());
    wait(1);
    EXPECT_EQ(vm.owner(), other) << "it comes back as the standby";
    std::swap(owner, other);
    term = vm.state()->term;
    befall(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over()) << describe();
    expect_moves_without_homing();
}

TEST_F(Standby, DoesNotDoACommandThatTheOwnerMayHaveBegun) {
    settle();
    vm.give_program(7, program_of({{90, 90}}, 40));
    const auto asked = vm.command(CommandKind::Run, 0, 7);
    wait(0.01);
    befall(Kind::Crash, owner, 100);
    ASSERT_TRUE(taken_over());
    const auto at = counts();
    vm.repeat_command();
    wait(0.1);
    const Reply* last = &vm.replies().back();
    EXPECT_EQ(last->sequence, asked);
    EXPECT_EQ(static_cast<FaultCode>(last->fault), FaultCode::CoordinatorChanged);
    wait(0.5);
    EXPECT_EQ(counts(), at);
}

/// Axes stop by themselves; whoever takes over must not refuse to say so.
TEST_F(Standby, TakesAnEmergencyStopThatTheOwnerNeverAnswered) {
    start_job();
    befall(Kind::Crash, owner, 100);
    wait(0.001);
    const auto asked = vm.command(CommandKind::EmergencyStop);
    ASSERT_TRUE(vm.advance_until([&] { return vm.owner() == other && vm.state()->term > term; }, ticks(3)));
    vm.repeat_command();
    wait(0.1);
    ASSERT_NE(vm.reply_to(asked), nullptr);
    EXPECT_EQ(vm.reply_to(asked)->status, ReplyStatus::Accepted) << vm.reply_to(asked)->text;
    EXPECT_EQ(fault(), FaultCode::EmergencyStopped);
}

}  // namespace
}  // namespace lockstep
