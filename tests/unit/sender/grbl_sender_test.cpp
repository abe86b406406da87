// A sender at a controller. The test writes the answers of the controller and sets the time.
#include "clients/sender/grbl_sender.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/sender/line_text.hpp"

namespace lockstep::sender {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;

class AtController : public testing::Test {
protected:
    /// Gives these bytes to the sender and returns its answer.
    std::string say(const std::string& bytes) {
        sender.receive(bytes, now);
        return passes(10ms);
    }
    std::string passes(std::chrono::nanoseconds time) {
        now += time;
        sender.pass(now);
        return sender.take_output();
    }
    void begin(int lines, const std::string& options = "[OPT:V,15,41]\r\n") {
        EXPECT_EQ(say("\r\nGrbl 1.1h ['$' for help]\r\n"), "$I\n");
        EXPECT_FALSE(sender.wants_line());
        sender.receive("[VER:1.1h.20190830:]\r\n" + options + "ok\r\n", now);
        EXPECT_TRUE(sender.wants_line());
        for (int i = 1; i <= lines; ++i) { sender.add(10 * i, "G1 X" + std::to_string(i)); }
        sender.end();
    }
    static std::string lines_in(const std::string& output) {
        std::string lines;
        for (const char c : output) {
            if (c != '?') { lines += c; }
        }
        return lines;
    }

    std::chrono::nanoseconds now{1h};
    GrblSender sender{false, now};
};

class LineByLine : public AtController {
protected:
    LineByLine() { sender = GrblSender(true, now); }
};

TEST_F(AtController, CountsTheCharactersThatTheBufferTakes) {
    begin(20);
    EXPECT_EQ(sender.room(), 40) << "one byte of it cannot be used";
    EXPECT_EQ(lines_in(passes(10ms)), "G1 X1\nG1 X2\nG1 X3\nG1 X4\nG1 X5\nG1 X6\n") << "36 bytes";
    EXPECT_EQ(lines_in(passes(10ms)), "");
    EXPECT_EQ(lines_in(say("ok\r\n")), "G1 X7\n");
    EXPECT_EQ(lines_in(say("ok\r\nok\r\n")), "G1 X8\nG1 X9\n");
    EXPECT_EQ(sender.answered(), 3);
}

TEST_F(LineByLine, SendsTheNextLineWhenTheOneBeforeIsAnswered) {
    begin(3);
    EXPECT_EQ(lines_in(passes(10ms)), "G1 X1\n");
    EXPECT_EQ(lines_in(passes(1s)), "");
    EXPECT_EQ(lines_in(say("ok\r\n")), "G1 X2\n");
}

TEST_F(AtController, IsDoneWhenTheMachineRests) {
    begin(2);
    (void)passes(10ms);
    (void)say("ok\r\nok\r\n");
    (void)say("<Run|MPos:1.000,0.000,0.000|FS:100,0>\r\n");
    EXPECT_EQ(sender.status(), "Run|MPos:1.000,0.000,0.000|FS:100,0");
    EXPECT_THAT(passes(1s), HasSubstr("?"));
    (void)say("<Idle|MPos:2.000,0.000,0.000|FS:0,0>\r\n");
    EXPECT_EQ(sender.outcome(), Outcome::Goes) << "it may have been on its way";
    (void)say("<Idle|MPos:2.000,0.000,0.000|FS:0,0>\r\n");
    EXPECT_EQ(sender.outcome(), Outcome::Done);
    EXPECT_EQ(sender.answered(), 2);
}

TEST_F(AtController, NamesTheLineThatIsRefusedAndStopsTheMachine) {
    begin(5);
    (void)passes(10ms);
    (void)say("ok\r\n[MSG:Y would leave its travel]\r\n");
    EXPECT_EQ(say("error:15\r\n"), "!?");
    EXPECT_EQ(say("<Hold:1|MPos:1.000>\r\n"), "") << "it brakes";
    EXPECT_EQ(say("ok\r\n<Hold:0|MPos:1.000>\r\n"), "\x18");
    EXPECT_EQ(sender.outcome(), Outcome::Goes);
    (void)say("\r\nGrbl 1.1h ['$' for help]\r\n");
    EXPECT_EQ(sender.outcome(), Outcome::Failed);
    ASSERT_TRUE(sender.trouble());
    EXPECT_EQ(sender.trouble()->line, 20);
    EXPECT_EQ(sender.trouble()->error, 15);
    EXPECT_THAT(sender.trouble()->text,
                AllOf(HasSubstr("G1 X2: error:15 Travel exceeded."), HasSubstr("Y would leave its travel")));
}

TEST_F(AtController, GivesTheRemedyForALockedMachine) {
    begin(1);
    (void)passes(10ms);
    (void)say("error:9\r\n");
    EXPECT_THAT(sender.trouble()->text, HasSubstr("Home ($H) or unlock ($X)"));
}

TEST_F(AtController, EndsAtAnAlarm) {
    begin(5);
    (void)passes(10ms);
    (void)say("ok\r\nALARM:1\r\n");
    EXPECT_EQ(sender.outcome(), Outcome::Failed);
    EXPECT_EQ(sender.trouble()->alarm, 1);
    EXPECT_THAT(sender.trouble()->text, HasSubstr("ALARM:1 Hard limit."));
    EXPECT_EQ(passes(1s), "") << "nothing more is sent";
}

TEST_F(AtController, StopsWithAHoldAndAResetAtRest) {
    begin(5);
    (void)passes(10ms);
    sender.stop(now);
    EXPECT_EQ(passes(10ms), "!?");
    sender.stop(now);
    EXPECT_EQ(say("<Hold:0|MPos:1.000>\r\n"), "\x18") << "once";
    (void)say("Grbl 1.1h\r\n");
    EXPECT_EQ(sender.outcome(), Outcome::Stopped);
}

TEST_F(AtController, ResetsAControllerThatDoesNotReportItsHold) {
    begin(5);
    (void)passes(10ms);
    sender.stop(now);
    (void)passes(10ms);
    EXPECT_THAT(passes(6s), HasSubstr("\x18"));
    (void)passes(6s);
    EXPECT_EQ(sender.outcome(), Outcome::Stopped);
}

TEST_F(AtController, DoesNotWaitForAGreetingThatDoesNotCome) {
    EXPECT_EQ(passes(1s), "");
    EXPECT_EQ(passes(2s), "$I\n");
    (void)say("error:3\r\n");
    EXPECT_TRUE(sender.wants_line()) << "an old controller without $I";
    EXPECT_EQ(sender.room(), LineFlow::kUsualRoom);
}

TEST_F(AtController, ReportsAPortWithoutAController) {
    (void)passes(3s);
    (void)say("login: ");
    (void)passes(11s);
    EXPECT_EQ(sender.outcome(), Outcome::Silent);
    EXPECT_THAT(sender.trouble()->text, HasSubstr("check the port and the speed"));
}

TEST_F(AtController, ReportsAControllerThatFallsSilentOrIsReset) {
    begin(5);
    (void)passes(10ms);
    (void)passes(11s);
    EXPECT_EQ(sender.outcome(), Outcome::Failed);
    EXPECT_THAT(sender.trouble()->text, HasSubstr("does not answer any more"));
    EXPECT_EQ(sender.trouble()->line, 10);
    sender = GrblSender(false, now);
    begin(5);
    (void)passes(10ms);
    (void)say("Grbl 1.1h ['$' for help]\r\n");
    EXPECT_EQ(sender.outcome(), Outcome::Failed);
    EXPECT_THAT(sender.trouble()->text, HasSubstr("was reset"));
}

TEST_F(AtController, WaitsLongForHoming) {
    begin(0);
    sender = GrblSender(false, now);
    (void)say("Grbl 1.1h\r\n");
    (void)say("ok\r\n");
    sender.add(1, "$H");
    sender.add(2, "G0 X1");
    sender.end();
    EXPECT_EQ(lines_in(passes(10ms)), "$H\n") << "alone: the controller may lose bytes meanwhile";
    (void)passes(60s);
    EXPECT_EQ(sender.outcome(), Outcome::Goes);
    EXPECT_EQ(lines_in(say("ok\r\n")), "G0 X1\n");
}

TEST_F(AtController, RefusesALineThatTheBufferNeverTakes) {
    begin(0);
    sender = GrblSender(false, now);
    (void)say("Grbl 1.1h\r\n");
    sender.receive("[OPT:V,15,41]\r\nok\r\n", now);
    sender.add(7, std::string(50, 'X'));
    sender.end();
    (void)passes(10ms);
    EXPECT_EQ(sender.trouble()->line, 7);
    EXPECT_THAT(sender.trouble()->text, HasSubstr("50 bytes"));
}

TEST_F(AtController, ToleratesGarbage) {
    begin(3);
    (void)passes(10ms);
    (void)say(std::string(100'000, '<'));
    (void)say(
        "\r\n[OPT:\r\n[MSG:\r\n<\r\nerror:\r\n[OPT:,,99999999999999999999]\r\nok\r\nok\r\nok\r\nok\r\nALARM:x\r\n");
    EXPECT_NE(sender.outcome(), Outcome::Done);
}

TEST(LineToSend, IsWithoutCommentsAndBlanks) {
    EXPECT_EQ(line_to_send("  G1 X1 (fast?) Y2 ; go!\r"), "G1 X1  Y2");
    EXPECT_EQ(line_to_send("(only)"), "");
    EXPECT_EQ(line_to_send("%"), "");
    EXPECT_EQ(line_to_send("( open"), "");
}

TEST(LineToSend, IsRefusedWithAByteThatTheControllerWouldObey) {
    for (const char* line : {"G1 X1!", "?", "~", "G1 X\x18", "G1 X1 \xC2\xB5"}) { EXPECT_FALSE(line_to_send(line)); }
    EXPECT_THAT(line_to_send("G1 !").error(), HasSubstr("'!'"));
}

TEST(LineToSend, IsSentAloneIfTheControllerStoresSomething) {
    for (const char* line : {"$110=1", "$H", "g10 L20 P1 X0", "G28.1"}) { EXPECT_TRUE(is_sent_alone(line)) << line; }
    for (const char* line : {"G1 X10", "G28", "G100"}) { EXPECT_FALSE(is_sent_alone(line)) << line; }
}

TEST(LineToSend, KnowsTheEndOfItsProgram) {
    for (const char* line : {"M2", "m30", "N90 M02", "G0 X1 M 3 0", "M9M2"}) {
        EXPECT_TRUE(ends_program(line)) << line;
    }
    for (const char* line : {"M3", "M20", "M300", "M2.1", "/M2", "#<m2>=5", "G0 X2"}) {
        EXPECT_FALSE(ends_program(line)) << line;
    }
}

}  // namespace
}  // namespace lockstep::sender
