// Lines of a sender on a machine in virtual time: joined, held, resumed, reset, starved, dropped.
#include "tests/unit/grbl/virtual_sender.hpp"

#include <algorithm>

namespace lockstep::grbl {
namespace {

using testing::HasSubstr;
using testing::Not;

int count(const std::string& text, const std::string& what) {
    int found = 0;
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) { ++found; }
    return found;
}

class Lines : public Rig {
protected:
    explicit Lines(const VirtualOptions& options = {.machine = small_machine()}) : Rig(options) {}
    void SetUp() override {
        home();
        sender.emplace(vm);
        pass(0.01);
        (void)sender->take_text();
    }
    /// Lets this many seconds of virtual time pass.
    void pass(double seconds) {
        (void)passes_until([] { return false; }, seconds);
    }
    bool passes_until(const std::function<bool()>& done, double seconds) {
        const Tick end = vm.now() + Ticks{static_cast<std::int64_t>(seconds * 1e6)};
        while (!done()) {
            if (vm.now() >= end) { return false; }
            (void)vm.advance_until([] { return false; }, Ticks{2'000});
            sender->pass();
        }
        return true;
    }
    std::string status() {
        kept_ += sender->take_text();
        sender->send("?");
        sender->pass();
        return sender->take_text();
    }
    bool becomes_idle(double seconds) {
        return passes_until([&] { return vm.state()->phase == MachinePhase::Idle && starts("<Idle"); }, seconds);
    }
    bool starts(const std::string& what) { return status().starts_with(what); }
    bool is_at_rest() const {
        return std::ranges::all_of(vm.axis_states(), [](const auto& axis) { return axis->at_rest; });
    }
    /// All answers except the status reports that status() requested.
    std::string answers() {
        kept_ += sender->take_text();
        return std::exchange(kept_, {});
    }
    /// A zigzag of short lines along X.
    static std::string zigzag(int from, int lines) {
        std::string text;
        for (int k = from; k < from + lines; ++k) {
            const int x = 5 + (k % 160 < 80 ? k % 80 : 80 - k % 80);
            text += "G1 X" + std::to_string(x) + " Y" + std::to_string(5 + k % 2) + " F2400\n";
        }
        return text;
    }

    std::optional<VirtualSender> sender;
    std::string kept_;
};

TEST_F(Lines, ASingleOneMovesTheMachineAtOnce) {
    sender->send("G0 X20 Y8\n");
    EXPECT_TRUE(passes_until([&] { return count(sender->text(), "ok") == 1; }, 0.01)) << "accepted";
    EXPECT_THAT(status(), HasSubstr("<Run|"));
    EXPECT_TRUE(passes_until([&] { return !is_at_rest(); }, 0.15)) << "it waits for no more lines";
    ASSERT_TRUE(becomes_idle(5));
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 800}));
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
}

TEST_F(Lines, AreJoinedAtSpeedAndEachIsAnsweredOnce) {
    int rests = 0;
    bool was_at_rest = true;
    std::string waiting = zigzag(0, 300);
    while (!waiting.empty()) {
        const std::size_t part = std::min<std::size_t>(waiting.size(), 1500);
        sender->send(waiting.substr(0, part));
        waiting.erase(0, part);
        (void)passes_until(
            [&] {
                rests += is_at_rest() && !was_at_rest ? 1 : 0;
                was_at_rest = is_at_rest();
                return false;
            },
            waiting.empty() ? 0.01 : 0.8);
    }
    ASSERT_TRUE(becomes_idle(60));
    EXPECT_EQ(rests, 0) << "until the last line";
    EXPECT_EQ(count(answers(), "ok"), 300);
    EXPECT_EQ(vm.state()->job, 2u) << "homing and one program";
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2600, 600}));
}

TEST_F(Lines, AreAcceptedAsFarAsThereIsRoom) {
    std::string text;
    for (int k = 0; k < 200; ++k) { text += k % 2 == 0 ? "G0 X90 Y90\n" : "G0 X10 Y10\n"; }
    sender->send("$10=2\n" + text);
    pass(0.5);
    EXPECT_EQ(count(answers(), "ok"), 129) << "the setting, and as many lines as the planner takes";
    EXPECT_THAT(status(), HasSubstr("|Bf:0,"));
    pass(3);
    const int more = count(answers(), "ok");
    EXPECT_GE(more, 1);
    EXPECT_LE(more, 5);
    sender->send("\x18");
    ASSERT_TRUE(becomes_idle(5));
    EXPECT_THAT(status(), HasSubstr("|Bf:128,4096"));
}

TEST_F(Lines, ThatComeOneByOneRestBetweenAndGoOn) {
    for (int k = 0; k < 6; ++k) {
        sender->send("G91 G1 X5 F2400\n");
        pass(0.4);
    }
    ASSERT_TRUE(becomes_idle(20));
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{3500, 500}));
    EXPECT_EQ(count(answers(), "ok"), 6);
    EXPECT_THAT(answers(), Not(HasSubstr("error")));
}

TEST_F(Lines, AreHeldOnThePathAndResumed) {
    sender->send(zigzag(0, 100));
    pass(1);
    ASSERT_FALSE(is_at_rest());
    sender->send("!");
    sender->pass();
    EXPECT_THAT(status(), HasSubstr("<Hold:1|"));
    ASSERT_TRUE(passes_until([&] { return vm.state()->phase == MachinePhase::Holding; }, 1));
    EXPECT_THAT(status(), HasSubstr("<Hold:0|"));
    pass(1);
    EXPECT_TRUE(is_at_rest());
    sender->send(zigzag(100, 20));
    pass(0.2);
    EXPECT_TRUE(is_at_rest()) << "lines that come meanwhile are accepted";
    sender->send("~");
    ASSERT_TRUE(becomes_idle(20));
    EXPECT_EQ(count(answers(), "ok"), 120);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{100 * (5 + 80 - 119 % 80), 600}));
}

TEST_F(Lines, MayBeHeldBeforeTheyBegin) {
    sender->send("G0 X50\n");
    sender->send("!");
    pass(2);
    EXPECT_TRUE(is_at_rest());
    EXPECT_EQ(counts()[0], 500) << "nothing has moved";
    EXPECT_THAT(status(), HasSubstr("<Hold:0|"));
    sender->send("~");
    ASSERT_TRUE(becomes_idle(5));
    EXPECT_EQ(counts()[0], 5000);
}

TEST_F(Lines, MayBeHeldAtAnyInstant) {
    for (int k = 0; k < 60; ++k) {
        sender->send("G91 G0 X" + std::string(k % 2 == 0 ? "7" : "-7") + "\nG0 Y" + (k % 2 == 0 ? "1" : "-1") + "\n");
        pass(0.004 * k);
        sender->send("!");
        pass(0.5);
        EXPECT_TRUE(is_at_rest()) << k;
        sender->send("~");
        ASSERT_TRUE(becomes_idle(5)) << k << " " << status() << describe();
    }
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

TEST_F(Lines, AreDroppedByAResetAndTheNextBeginWhereTheMachineRests) {
    sender->send("G90 G1 F2400\n" + zigzag(0, 150));
    pass(2);
    ASSERT_FALSE(is_at_rest());
    sender->send("\x18G91 G0 Y10\n");
    const std::int64_t y = counts()[1];
    ASSERT_TRUE(becomes_idle(5));
    EXPECT_THAT(answers(), HasSubstr("Grbl 1.1h"));
    EXPECT_NEAR(static_cast<double>(counts()[1] - y), 1000, 150);
    EXPECT_GT(counts()[0], 600);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(fault(), FaultCode::None);
}

TEST_F(Lines, MayBeResetAtAnyInstant) {
    for (int k = 0; k < 60; ++k) {
        sender->send("G90 G0 X40 Y20\nG0 X10 Y7\n");
        pass(0.003 * k);
        sender->send("\x18");
        ASSERT_TRUE(becomes_idle(5)) << k << " " << status() << describe();
        EXPECT_TRUE(is_at_rest());
    }
    sender->send("G0 X10 Y10\n");
    ASSERT_TRUE(becomes_idle(5));
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000}));
}

TEST_F(Lines, AreRunFasterAndSlowerByOverrides) {
    sender->send("G1 X95 F1200\n");
    pass(1);
    sender->send("\x91\x91");
    pass(0.7);
    EXPECT_EQ(vm.state()->overrides.feed_percent, 120);
    EXPECT_THAT(status(), HasSubstr("|FS:1440,0"));
    sender->send("\x90");
    pass(0.7);
    EXPECT_THAT(status(), HasSubstr("|FS:1200,0"));
    ASSERT_TRUE(becomes_idle(10));
    EXPECT_EQ(counts()[0], 9500);
}

TEST_F(Lines, NameThemselvesInTheStatus) {
    sender->send("N100 G1 X30 F1200\nN110 G1 Y30\n");
    pass(0.8);
    EXPECT_THAT(status(), HasSubstr("|Ln:100|"));
    pass(1.5);
    EXPECT_THAT(status(), HasSubstr("|Ln:110|"));
    ASSERT_TRUE(becomes_idle(10));
    EXPECT_THAT(status(), Not(HasSubstr("|Ln:")));
}

TEST_F(Lines, TheHomeSwitchIsInTheStatusWhileItIsClosed) {
    EXPECT_THAT(status(), Not(HasSubstr("|Pn:")));
    (void)vm.command(CommandKind::Home, {AxisIndex{kY}});
    EXPECT_TRUE(passes_until([&] { return status().find("|Pn:Y") != std::string::npos; }, 10));
    EXPECT_TRUE(becomes_idle(20));
    EXPECT_THAT(status(), Not(HasSubstr("|Pn:")));
}

TEST_F(Lines, AreCountedWithinTheirProgramWhereTheyHaveNoNumber) {
    for (int repeated = 0; repeated < 2; ++repeated) {
        sender->send("G90\nG1 X30 F1200\nG1 Y30\nX5\nY5\nM2\n");
        pass(0.8);
        EXPECT_THAT(status(), HasSubstr("|Ln:2|")) << "the line in motion, not the last received";
        pass(1);
        EXPECT_THAT(status(), HasSubstr("|Ln:3|"));
        ASSERT_TRUE(becomes_idle(20));
    }
}

TEST_F(Lines, ADwellAndAPauseAreAnsweredBehindThem) {
    sender->send("G1 X10 F1200\nG4 P0.5\nG1 X12\nM0\nG1 X14\n");
    pass(0.3);
    EXPECT_EQ(count(answers(), "ok"), 1) << "the dwell is not over";
    ASSERT_TRUE(passes_until([&] { return vm.state()->phase == MachinePhase::Paused; }, 5)) << describe();
    EXPECT_EQ(count(answers(), "ok"), 2);
    EXPECT_THAT(status(), HasSubstr("<Hold:0|"));
    EXPECT_EQ(counts()[0], 1200);
    sender->send("~");
    ASSERT_TRUE(becomes_idle(5));
    EXPECT_EQ(counts()[0], 1400);
    EXPECT_EQ(count(answers(), "ok"), 2);
}

TEST_F(Lines, TheSenderIsToldWhyItsJobPausesWhenTheMachineHasComeToThePause) {
    sender->send("(MSG, turn the part over)\nG1 X12 F600\nM0\nG1 X14\n");
    pass(0.3);
    EXPECT_EQ(sender->text().find("Program stop"), std::string::npos) << "it still moves";
    ASSERT_TRUE(passes_until([&] { return vm.state()->phase == MachinePhase::Paused; }, 5)) << describe();
    pass(0.1);
    EXPECT_NE(sender->text().find("[MSG:Program stop: turn the part over]"), std::string::npos) << sender->text();
    sender->send("~");
    ASSERT_TRUE(becomes_idle(5));
}

TEST_F(Lines, AStopByAnotherClientIsAnAlarmAndTheRestIsRefused) {
    sender->send(zigzag(0, 200));
    pass(1);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    pass(1);
    EXPECT_THAT(answers(), HasSubstr("ALARM:3"));
    sender->send("G0 X50\n");
    pass(1);
    EXPECT_THAT(answers(), HasSubstr("error:9"));
    EXPECT_THAT(status(), HasSubstr("<Alarm|"));
    sender->send("$X\nG0 X50 Y50\n");
    ASSERT_TRUE(becomes_idle(5));
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{5000, 5000}));
}

TEST_F(Lines, AFaultIsOneAlarm) {
    sender->send(zigzag(0, 200));
    pass(1);
    ASSERT_EQ(ask(CommandKind::EmergencyStop).status, ReplyStatus::Accepted);
    pass(1);
    EXPECT_EQ(count(answers(), "ALARM:"), 1);
    EXPECT_THAT(status(), HasSubstr("<Alarm|"));
}

TEST_F(Lines, OfASenderThatDiesInALineAreRunToTheEndOfWhatWasAccepted) {
    sender->send("G1 X30 F2400\nG1 X40\nG1 X5");
    pass(0.3);
    sender->leave();
    ASSERT_TRUE(passes_until([&] { return vm.state()->phase == MachinePhase::Idle; }, 5));
    EXPECT_EQ(counts()[0], 4000);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(fault(), FaultCode::None);
}

TEST_F(Lines, AreNotDisturbedByAFloodOfQuestions) {
    sender->send(zigzag(0, 120));
    int rests = 0;
    for (int k = 0; k < 1500; ++k) {
        sender->send(std::string(20, '?'));
        (void)vm.advance_until([] { return false; }, Ticks{2'000});
        sender->pass();
        rests += k > 500 && is_at_rest() ? 1 : 0;
    }
    EXPECT_EQ(rests, 0);
    const std::string text = sender->take_text();
    EXPECT_EQ(count(text, "\n<") + (text.starts_with("<") ? 1 : 0), 1500) << "an answer for each burst";
    ASSERT_TRUE(becomes_idle(20));
}

TEST_F(Lines, OfTwoSendersAreNotMixed) {
    VirtualSender other(vm, 80);
    (void)other.take_text();
    sender->send(zigzag(0, 150));
    pass(1);
    other.pass();
    other.send("G0 X90 Y90\n");
    other.pass();
    EXPECT_THAT(other.take_text(), HasSubstr("another client's job is in progress"));
    ASSERT_TRUE(becomes_idle(20));
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{100 * (5 + 80 - 149 % 80), 600}));
}

/// The protocol accepts a line of each sender before either begins. One sender gets an alarm.
TEST_F(Lines, OfTwoSendersAtOnceAreRunByOne) {
    VirtualSender other(vm, 80);
    sender->send("G0 X50\n");
    other.send("G0 Y50\n");
    for (int k = 0; k < 2000; ++k) {
        (void)vm.advance_until([] { return false; }, Ticks{2'000});
        sender->pass();
        other.pass();
    }
    const std::vector<std::int64_t> first{5000, 500};
    const std::vector<std::int64_t> second{500, 5000};
    EXPECT_TRUE(counts() == first || counts() == second) << counts()[0] << " " << counts()[1];
    EXPECT_EQ(count(answers() + other.take_text(), "ALARM:3"), 1);
}

class LaiLines : public Lines {
protected:
    static VirtualOptions options() {
        VirtualOptions options{.machine = small_machine()};
        options.machine.coordination = StepMethod::Lai;
        return options;
    }
    LaiLines() : Lines(options()) {}
};

TEST_F(LaiLines, AreRunWhenAProgramOfThemIsWhole) {
    for (int k = 0; k < 3; ++k) {
        sender->send("G1 X30 Y30 F2400\nG1 X20 Y10\n");
        pass(0.1);
    }
    ASSERT_TRUE(becomes_idle(20)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000}));
    EXPECT_EQ(count(answers(), "ok"), 6);
}

TEST_F(Lines, WaitForACoordinatorThatTakesThemLate) {
    sender->port().loses_parts = true;
    sender->send("G1 X12 F600\n");
    pass(20);
    EXPECT_THAT(answers(), Not(HasSubstr("ALARM")));
    sender->port().loses_parts = false;
    EXPECT_TRUE(becomes_idle(5));
    EXPECT_EQ(counts()[0], 1200);
}

TEST_F(Lines, AreLostWithACoordinatorThatTakesNone) {
    sender->port().loses_parts = sender->port().is_silent = true;
    sender->send("G1 X12 F600\n");
    pass(2);
    EXPECT_THAT(answers(), Not(HasSubstr("ALARM")));
    pass(2);
    EXPECT_THAT(answers(), HasSubstr("ALARM:3"));
}

}  // namespace
}  // namespace lockstep::grbl
