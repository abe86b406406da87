// Programs that are sent while they run: they starve, continue, settle, end early, and are taken over.
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using Kind = VirtualFault::Kind;

/// A zigzag along X, there and back, with a corner at each line.
class Stream : public Rig {
protected:
    static constexpr std::uint64_t kProgram = 50;
    static constexpr double kFeed_mm_s = 40;

    explicit Stream(const VirtualOptions& options = {.machine = small_machine()}) : Rig(options) {}

    std::vector<Block> moves(int count) {
        std::vector<Block> blocks;
        for (int k = 0; k < count; ++k) {
            ++line;
            x_mm = 5 + (line % 160 < 80 ? line % 80 : 80 - line % 80);
            y_mm = 5 + line % 2;
            blocks.push_back({line, ProgramMove{{x_mm, y_mm}, kFeed_mm_s}});
        }
        return blocks;
    }
    Reply send(ProgramPart part) {
        part.program = kProgram;
        part.index = index;
        part.head = {"stream", {"X", "Y"}, {5, 5}};
        for (int tries = 0; tries < 20; ++tries) {
            const std::uint64_t sequence = vm.send(part);
            const auto is_answered = [&] { return vm.reply_to(sequence) != nullptr; };
            if (!vm.advance_until(is_answered, Ticks{250'000})) { continue; }
            const Reply reply = *vm.reply_to(sequence);
            index = reply.parts;
            return reply;
        }
        return {.status = ReplyStatus::Refused, .text = "no reply"};
    }
    void begin(int count) {
        home();
        ASSERT_EQ(send({.blocks = moves(count)}).status, ReplyStatus::Accepted);
        ASSERT_EQ(ask(CommandKind::Run, {}, kProgram).status, ReplyStatus::Accepted);
    }
    /// The end of the moves that were sent so far, in steps.
    std::vector<std::int64_t> end() const { return {std::lround(x_mm * 100), std::lround(y_mm * 100)}; }
    bool is_at_rest() const {
        return std::ranges::all_of(vm.axis_states(), [](const auto& axis) { return axis && axis->at_rest; });
    }
    bool starves(double seconds) {
        wait(0.2);  // until the state includes the last part that was sent
        return vm.advance_until([&] { return vm.state()->lacks_blocks && is_at_rest(); },
                                Ticks{static_cast<std::int64_t>(seconds * 1e6)});
    }
    void expect_done() {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        EXPECT_EQ(fault(), FaultCode::None);
        EXPECT_EQ(counts(), end());
    }
    void expect_cut(FaultCode why) {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
        EXPECT_EQ(vm.state()->job_fault, why);
        EXPECT_EQ(vm.state()->line, line) << "the last one that is known";
        EXPECT_EQ(counts(), end()) << "at its end";
        ASSERT_EQ(run(program_of({{x_mm, 20}}, 40, {x_mm, y_mm})).status, ReplyStatus::Accepted)
            << "the next job begins";
        ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
        EXPECT_EQ(vm.state()->job_fault, FaultCode::None);
    }

    std::int32_t line = 0;
    double x_mm = 5;
    double y_mm = 5;
    std::uint32_t index = 0;
};

TEST_F(Stream, RunsWhileItGrowsWithoutAStop) {
    begin(60);
    for (int part = 0; part < 10; ++part) {
        ASSERT_EQ(send({.is_last = part == 9, .blocks = moves(40)}).status, ReplyStatus::Accepted);
        wait(0.5);
        EXPECT_FALSE(is_at_rest()) << part;
    }
    expect_done();
}

TEST_F(Stream, RestsOnThePathWhenItStarvesAndGoesOnByItself) {
    begin(60);
    for (int part = 0; part < 4; ++part) {
        ASSERT_TRUE(starves(10)) << describe();
        EXPECT_EQ(vm.state()->phase, MachinePhase::Running);
        EXPECT_EQ(fault(), FaultCode::None);
        EXPECT_NE(counts(), end()) << "it keeps the way that it needs to stop";
        ASSERT_EQ(send({.is_last = part == 3, .blocks = moves(part == 3 ? 0 : 30)}).status, ReplyStatus::Accepted);
    }
    expect_done();
}

TEST_F(Stream, MayBeginWithoutAnyBlock) {
    begin(0);
    wait(1);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running);
    EXPECT_TRUE(vm.state()->lacks_blocks);
    ASSERT_EQ(send({.is_last = true, .blocks = moves(20)}).status, ReplyStatus::Accepted);
    expect_done();
}

TEST_F(Stream, ASettleRunsAllThatWasSent) {
    begin(20);
    for (int part = 0; part < 3; ++part) {
        auto blocks = moves(10);
        blocks.push_back({line, Settle{}});
        ASSERT_EQ(send({.blocks = blocks}).status, ReplyStatus::Accepted);
        ASSERT_TRUE(starves(10)) << describe();
        EXPECT_EQ(counts(), end());
    }
    ASSERT_EQ(send({.is_last = true}).status, ReplyStatus::Accepted);
    expect_done();
}

TEST_F(Stream, IsHeldResumedAndStoppedWhileItStarves) {
    begin(40);
    ASSERT_TRUE(starves(10));
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 2)) << describe();
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_EQ(send({.blocks = moves(40)}).status, ReplyStatus::Accepted);
    wait(0.5);
    EXPECT_FALSE(is_at_rest());
    ASSERT_TRUE(starves(10));
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
}

TEST_F(Stream, ASilentSenderEndsTheJobBehindTheLastLine) {
    begin(60);
    ASSERT_TRUE(starves(10));
    wait(8);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running) << "it may still come";
    expect_cut(FaultCode::SenderSilent);
    EXPECT_EQ(send({.blocks = moves(1)}).status, ReplyStatus::Refused) << "it came too late, and is told";
}

TEST_F(Stream, AQuestionShowsThatTheSenderLives) {
    begin(20);
    for (int n = 0; n < 20; ++n) {
        (void)send({.is_question = true});
        wait(1);
    }
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running);
    ASSERT_EQ(send({.is_last = true, .blocks = moves(1)}).status, ReplyStatus::Accepted);
    expect_done();
}

TEST_F(Stream, ASenderThatCannotReadOnEndsTheJobBehindTheLastLine) {
    begin(60);
    ASSERT_EQ(send({.is_last = true, .blocks = moves(30), .cut = "line 91: nonsense"}).status, ReplyStatus::Accepted);
    expect_cut(FaultCode::ProgramCutShort);
}

TEST_F(Stream, APartThatTheMachineCannotRunIsRefusedAndWhatIsBeforeItIsRun) {
    begin(60);
    const std::int32_t known = line;
    const double x = x_mm;
    const double y = y_mm;
    auto blocks = moves(10);
    blocks.push_back({++line, ProgramMove{{300, 5}, kFeed_mm_s}});
    const Reply reply = send({.blocks = blocks});
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_EQ(reply.fault, FaultCode::OutsideTravel);
    EXPECT_NE(reply.text.find("line 71"), std::string::npos) << reply.text;
    line = known;
    x_mm = x;
    y_mm = y;
    expect_cut(FaultCode::OutsideTravel);
}

TEST_F(Stream, OverridesTurnedWhileItStarvesHoldBehindTheRest) {
    begin(40);
    ASSERT_TRUE(starves(10));
    (void)vm.set_overrides({50, 100});
    wait(0.1);
    ASSERT_EQ(send({.is_last = true, .blocks = moves(40)}).status, ReplyStatus::Accepted);
    const Tick begun = vm.now();
    expect_done();
    EXPECT_GT((vm.now() - begun).value, 2'600'000) << "40 lines of 1.4 mm at 20 mm/s";
}

class StreamTakenOver : public Stream {
protected:
    StreamTakenOver() : Stream({.machine = small_machine(), .on_takeover = OnTakeover::Continue, .coordinators = 2}) {}
    void crash_owner() {
        owner = vm.owner().value();
        vm.schedule({.kind = Kind::Crash, .process = owner, .at = vm.now(), .lasts = Ticks{100'000'000}});
        ASSERT_TRUE(vm.advance_until([&] { return vm.owner() && *vm.owner() != owner; }, Ticks{3'000'000}));
    }
    std::size_t owner = 0;
};

TEST_F(StreamTakenOver, GoesOnWithWhatIsSentToTheNextOwner) {
    begin(80);
    wait(1);
    crash_owner();
    for (int part = 0; part < 4; ++part) {
        ASSERT_EQ(send({.is_last = part == 3, .blocks = moves(40)}).status, ReplyStatus::Accepted) << part;
        wait(0.3);
    }
    expect_done();
}

TEST_F(StreamTakenOver, GoesOnFromARestInWhichItStarved) {
    begin(60);
    ASSERT_TRUE(starves(10));
    crash_owner();
    wait(1);
    ASSERT_EQ(send({.is_last = true, .blocks = moves(40)}).status, ReplyStatus::Accepted);
    expect_done();
}

TEST_F(StreamTakenOver, EndsWhereTheSenderFellSilent) {
    begin(60);
    wait(0.5);
    crash_owner();
    expect_cut(FaultCode::SenderSilent);
}

}  // namespace
}  // namespace lockstep
