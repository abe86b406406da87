// A sender of grbl's protocol and a machine of real processes: over TCP and over a pseudo-terminal.
#include "tests/integration/cli/senders/grbl_machine.hpp"
#include "tests/integration/cli/terminal.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

TEST_F(GrblSender, HomesJogsAndSetsTheWorkZero) {
    Sender sender = connected();
    EXPECT_THAT(sender.status(), HasSubstr("Alarm|"));
    EXPECT_TRUE(sender.answers("G0 X1", "error:9"));
    EXPECT_TRUE(sender.answers("$H", "ok"));
    EXPECT_TRUE(status().axes(1).homed());
    EXPECT_THAT(sender.status(), HasSubstr("Idle|MPos:"));
    const std::int64_t before = steps_of_x();
    EXPECT_TRUE(sender.answers("$J=G91 X10 F3000", "ok"));
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    EXPECT_EQ(steps_of_x(), before + 800);
    EXPECT_TRUE(sender.answers("G10 L20 P1 X0", "ok"));
    EXPECT_TRUE(sender.answers("$#", "[G54:" + std::to_string((before + 800) / 80)));
    EXPECT_TRUE(sender.answers("$J=X-2 F3000", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == before + 640 && status().phase() == "Idle"; }));
    EXPECT_TRUE(sender.answers("$J=X1000 F3000", "error:15"));
    EXPECT_TRUE(sender.answers("$100", "error:3"));
    EXPECT_TRUE(sender.answers("$$", "$100=80.000"));
    EXPECT_TRUE(sender.answers("G1 X0 F3000", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == before + 800 && status().phase() == "Idle"; }));
    sender.send("\x91");
    EXPECT_TRUE(eventually([&] { return status().feed_override_percent() == 110; }));
}

TEST_F(GrblSender, StreamsLinesHoldsResumesAndResets) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    Sender sender = connected();
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    for (int k = 0; k < 100; ++k) {
        ASSERT_TRUE(
            sender.answers("G1 X" + std::to_string(20 + k) + " Y" + std::to_string(20 + k % 2) + " F3000", "ok"));
    }
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Run"); }));
    sender.send("!");
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Hold:0"); }));
    EXPECT_EQ(status().phase(), "Holding");
    sender.send("~");
    EXPECT_TRUE(eventually([&] { return steps_of_x() == 119 * 80 && status().phase() == "Idle"; }));
    ASSERT_TRUE(sender.answers("G1 X10 F1200", "ok"));  // some seconds, so that the reset comes in time
    EXPECT_TRUE(eventually([&] { return status().phase() == "Running" && steps_of_x() < 119 * 80; }));
    sender.send("\x18");
    EXPECT_TRUE(sender.receives("Grbl 1.1h"));
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    EXPECT_GT(steps_of_x(), 10 * 80);
    ASSERT_TRUE(sender.answers("G4 P0.1", "ok"));
    ASSERT_TRUE(sender.answers("G0 X30", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == 30 * 80 && status().phase() == "Idle"; }));
}

TEST_F(GrblSender, KeepsParametersAndModesUntilAReset) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    Sender sender = connected();
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    EXPECT_TRUE(sender.answers("#1=50", "ok"));
    EXPECT_TRUE(sender.answers("G0 X#1", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == 50 * 80 && status().phase() == "Idle"; }));
    sender.send("#<x>=20\nG91 F3000\nG1 X#<x>\nX#<x>\n");  // in one packet
    EXPECT_TRUE(eventually([&] { return steps_of_x() == 90 * 80 && status().phase() == "Idle"; }));
    EXPECT_TRUE(sender.answers("o100 repeat [3]", "needs the lines that follow it"));
    EXPECT_TRUE(sender.receives("error:20"));
    EXPECT_TRUE(sender.answers("X1", "within O100 REPEAT"));
    sender.send("\x18");
    EXPECT_TRUE(sender.receives("Grbl 1.1h"));
    EXPECT_TRUE(sender.answers("G0 X#1", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == 0 && status().phase() == "Idle"; }));
}

TEST_F(GrblSender, LeavesAndItsJogBrakes) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    {
        Sender sender = connected();
        EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
        ASSERT_TRUE(sender.answers("$J=G91 X150 F600", "ok"));
        EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Jog"); }));
    }
    EXPECT_TRUE(becomes("Idle"));
    const std::int64_t rests_at = steps_of_x();
    EXPECT_LT(rests_at, 150 * 80);
    Sender sender = connected();
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    ASSERT_TRUE(sender.answers("$J=G91 X100 F600", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() > rests_at; }));
    sender.send("\x85");
    EXPECT_TRUE(becomes("Idle"));
    EXPECT_LT(steps_of_x(), 180 * 80);
}

TEST_F(GrblSender, HasTheMachineForItselfWhileItWorks) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    Sender sender = connected();
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    EXPECT_FALSE(status().has_writer()) << "it has asked for nothing yet";
    ASSERT_TRUE(sender.answers("$J=G91 X150 F600", "ok"));
    EXPECT_EQ(status().writer().name(), "the grbl sender at 127.0.0.1");
    const Ran refused = run_lockstep({"override", "--feed", "50"});
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("the grbl sender at 127.0.0.1 on "));
    EXPECT_EQ(run_lockstep({"override", "--feed", "50", "--take"}).code, 0);
    EXPECT_TRUE(becomes("Idle"));
    EXPECT_LT(steps_of_x(), 150 * 80) << "the jog brakes";
}

TEST_F(GrblSender, IsRefusedWhileAnotherHasTheMachine) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    Sender sender = connected();
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    {
        Terminal jog("jog");
        ASSERT_TRUE(jog.shows("left, right"));
        EXPECT_TRUE(sender.answers("G0 X50", "has been the machine's writer for"));
        EXPECT_TRUE(sender.receives("error:9"));
        EXPECT_TRUE(sender.answers("$J=G91 X1 F600", "error:9"));
        EXPECT_TRUE(sender.answers("G10 L20 P1 X0", "error:9"));
        jog.type("q");
        EXPECT_EQ(jog.wait(), 0);
    }
    EXPECT_TRUE(sender.answers("G0 X50", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == 50 * 80 && status().phase() == "Idle"; }));
    EXPECT_TRUE(status().has_writer());
    EXPECT_TRUE(eventually([&] { return !status().has_writer(); })) << "it has rested for a while";
}

TEST_F(GrblSender, MayUseATerminalAndComeAgain) {
    ASSERT_TRUE(eventually([&] { return ::access(terminal_.c_str(), R_OK | W_OK) == 0; }));
    for (int i = 0; i < 2; ++i) {
        auto sender = Sender::over_terminal(terminal_);
        ASSERT_TRUE(sender);
        sender->send("\x18");  // a sender that reconnects at once is greeted only after a reset
        EXPECT_TRUE(sender->receives("Grbl 1.1h ['$' for help]")) << i;
        EXPECT_TRUE(sender->answers("$I", "[VER:1.1h."));
        EXPECT_TRUE(sender->receives("ok"));
        EXPECT_TRUE(eventually([&] { return sender->status().starts_with("Alarm|MPos:"); }));
    }
}

TEST_F(GrblSender, WritesSettingsThatAreInForceAfterARestart) {
    ASSERT_TRUE(eventually([&] { return ::access(terminal_.c_str(), R_OK | W_OK) == 0; }));
    auto sender = Sender::over_terminal(terminal_);
    ASSERT_TRUE(sender);
    EXPECT_TRUE(sender->answers("$110=3000", "[MSG:$110 is stored and applies after: lockstep down; lockstep up]"));
    EXPECT_TRUE(sender->receives("ok"));
    EXPECT_TRUE(sender->answers("$$", "$110=3000.000"));
    EXPECT_TRUE(sender->receives("[MSG:$110 applies after: lockstep down; lockstep up]"));
    EXPECT_TRUE(sender->answers("$110=1", "below start_velocity_mm_s 10"));
    EXPECT_TRUE(sender->receives("error:101"));
    EXPECT_TRUE(sender->answers("$0=5", "error:100"));
    EXPECT_EQ(run_lockstep({"down"}).code, 0);
    EXPECT_THAT(run_lockstep({"up"}).out, HasSubstr("X.max_velocity_mm_s: 50"));
    EXPECT_TRUE(sender->receives("Grbl 1.1h")) << "the machine is another";
    EXPECT_TRUE(sender->answers("$$", "$110=3000.000"));
    EXPECT_TRUE(sender->answers("$H", "ok"));
    EXPECT_TRUE(sender->answers("$RST=$", "ok"));
    EXPECT_TRUE(sender->answers("$$", "$110=9000.000"));
    EXPECT_EQ(run_lockstep({"config", "--json"}).json<proto::SettingsReport>().settings_size(), 0);
}

TEST_F(GrblSender, OfGarbageAFloodAndAMegabyteDoesNoHarm) {
    Sender sender = connected();
    std::string garbage;
    for (int i = 0; i < 20'000; ++i) { garbage += static_cast<char>((i * 7919) >> 3); }
    sender.send(garbage);
    sender.send(std::string(20'000, '?'));
    sender.send("\x18");
    EXPECT_TRUE(sender.receives("Grbl 1.1h"));
    sender.send(std::string(1'000'000, 'X') + "\n");
    EXPECT_TRUE(sender.receives("error:11"));
    EXPECT_TRUE(sender.answers("$G", "[GC:G0 G54 G17 G21 G90 G94"));
    auto second = Sender::over_tcp();
    ASSERT_TRUE(second);
    EXPECT_TRUE(second->receives("another sender is connected"));
    EXPECT_EQ(status().phase(), "Idle");
}

}  // namespace
}  // namespace lockstep
