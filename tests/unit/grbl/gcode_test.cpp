// Lines of G-code, sent by the test: the requests that they become, and their answers.
#include "tests/unit/grbl/hand_sender.hpp"

namespace lockstep::grbl {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(Sender, SetsModesAndOffsetsByLinesThatMoveNothing) {
    EXPECT_THAT(send("G20 G91 G55 F10\n"), ElementsAre("ok"));
    EXPECT_THAT(send("$G\n")[0], HasSubstr("G55 G17 G20 G91 G94 M5 M9 T0 F10 S0"));
    EXPECT_THAT(send("G21 G10 L20 P1 X0 Y5\n"), ElementsAre()) << "until the machine has stored it";
    ASSERT_THAT(asked(), ElementsAre(Kind::SetValues));
    EXPECT_EQ(requests[0].values.systems[0].origin, (gcode::Point{10, 15, 0}));
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(lines(), ElementsAre("ok"));
    EXPECT_THAT(send("G999\n"), ElementsAre(StartsWith("[MSG:"), "error:20"));
    EXPECT_THAT(send("M2\n$G\n"), ElementsAre("[MSG:Pgm End]", "ok", HasSubstr("G54 G17 G21 G90"), "ok"));
}

TEST_F(Sender, HasEachLineThatMovesBeginWhereTheOneBeforeEnds) {
    EXPECT_THAT(send("G1 X12 F120\nN70 G91 X3\nG90 G2 X17 Y20 I1\n"), ElementsAre()) << "until one is accepted";
    ASSERT_THAT(asked(), ElementsAre(Kind::RunLine));
    EXPECT_EQ(requests[0].line.from_mm, (std::vector<double>{10, 20, 30}));
    ASSERT_EQ(requests[0].line.blocks.size(), 1u);
    const auto& move = std::get<ProgramMove>(requests[0].line.blocks[0].action);
    EXPECT_EQ(move.target_mm, (std::vector<double>{12, 20, 30}));
    EXPECT_DOUBLE_EQ(move.feed_mm_s, 2);
    EXPECT_DOUBLE_EQ(requests[0].line.seconds, 1);
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(lines(), ElementsAre("ok"));
    EXPECT_THAT(status(), StartsWith("<Run|")) << "before the machine's state shows it";
    ASSERT_THAT(asked(), ElementsAre(Kind::RunLine));
    EXPECT_EQ(requests[0].line.from_mm, (std::vector<double>{12, 20, 30}));
    EXPECT_EQ(requests[0].line.sender_line, 70);
    grbl.answer(requests[0].number, {.is_done = true});
    ASSERT_THAT(asked(), ElementsAre(Kind::RunLine));
    EXPECT_EQ(requests[0].line.from_mm, (std::vector<double>{15, 20, 30}));
    ASSERT_EQ(requests[0].line.blocks.size(), 1u);
    EXPECT_TRUE(std::get<ProgramMove>(requests[0].line.blocks[0].action).arc) << "an arc is one move";
}

TEST_F(Sender, IsRefusedALineByTheCoordinator) {
    (void)send("G0 X12\n");
    ASSERT_THAT(asked(), ElementsAre(Kind::RunLine));
    grbl.answer(requests[0].number, {.text = "no"});
    EXPECT_THAT(lines(), ElementsAre("[MSG:no]", "error:9"));
}

TEST_F(Sender, IsToldWhatIsWrongWithALineByGrblsNumbers) {
    for (const auto& [line, number] : {std::pair{"G1 X12", 22},
                                       {"12", 1},
                                       {"G0 X", 2},
                                       {"G0 X1.2.3", 2},
                                       {"G0 G1 X1 F100", 21},
                                       {"G0 X1 X2", 25},
                                       {"G2 X11 Y21 I50 F100", 33},
                                       {"G38.2 Z1 F10", 20},
                                       {"G41 D1", 20},
                                       {"o100 sub", 20},
                                       {"M3 S100", 20}}) {
        EXPECT_THAT(send(std::string(line) + "\n"), ElementsAre(StartsWith("[MSG:"), "error:" + std::to_string(number)))
            << line;
    }
    EXPECT_THAT(asked(), ElementsAre());
    EXPECT_THAT(send("$G\n")[0], HasSubstr("G0 G54 G17 G21 G90 G94")) << "none of them has changed a mode";
}

TEST_F(Sender, GetsAnAlarmForATargetOutsideTheTravel) {
    (void)send("G0 X12\n");
    asked();
    grbl.answer(requests[0].number, {.is_done = true});
    (void)lines();
    EXPECT_THAT(send("G0 X300\nG0 X12\n"),
                ElementsAre("ALARM:2", HasSubstr("outside its travel"), "error:15", "error:9"));
    EXPECT_THAT(asked(), ElementsAre(Kind::Stop)) << "of the lines before it";
    change(MachinePhase::Idle);
    EXPECT_THAT(status(), StartsWith("<Alarm|"));
    EXPECT_THAT(send("$X\n"), ElementsAre("[MSG:Caution: Unlocked]", "ok"));
    EXPECT_THAT(status(), StartsWith("<Idle|"));
}

TEST_F(Sender, HasOffsetsSetWhenTheLinesBeforeWereRun) {
    (void)send("G0 X12\n");
    asked();
    view.lines = 1;
    grbl.answer(requests[0].number, {.is_done = true});
    change(MachinePhase::Running);
    (void)lines();
    EXPECT_THAT(send("G92 X0\nG0 X1\n"), ElementsAre());
    EXPECT_THAT(asked(), ElementsAre());
    view.lines = 0;
    view.axes[0] = {11, true, false};
    change(MachinePhase::Idle);
    EXPECT_THAT(asked(), ElementsAre()) << "where the axis rests is not known yet";
    view.axes[0] = {12, true, true};
    grbl.see(view);
    ASSERT_THAT(asked(), ElementsAre(Kind::SetValues));
    EXPECT_EQ(requests[0].values.g92[0], 12);
    view.values = requests[0].values;
    grbl.see(view);
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(lines(), ElementsAre("ok"));
    ASSERT_THAT(asked(), ElementsAre(Kind::RunLine));
    EXPECT_EQ(std::get<ProgramMove>(requests[0].line.blocks[0].action).target_mm[0], 13);
}

TEST_F(Sender, HasADwellAndAPauseAnsweredWhenTheyWereRun) {
    for (const std::string line : {"G4 P0.5", "M0", "G0 X12"}) {
        (void)send(line + "\n");
        ASSERT_THAT(asked(), ElementsAre(Kind::RunLine)) << line;
        EXPECT_EQ(requests[0].line.is_answered_behind, line != "G0 X12") << line;
        grbl.answer(requests[0].number, {.is_done = true});
        view.lines = line == "G0 X12" ? 1 : 0;
        grbl.see(view);
        EXPECT_THAT(lines(), ElementsAre("ok"));
    }
    EXPECT_THAT(send("M2\n"), ElementsAre());
    EXPECT_THAT(asked(), ElementsAre());
    view.lines = 0;
    grbl.see(view);
    EXPECT_THAT(lines(), ElementsAre("[MSG:Pgm End]", "ok")) << "behind the last move";
}

TEST_F(Sender, AlarmDropsItsLines) {
    (void)send("G0 X12\n");
    asked();
    grbl.answer(requests[0].number, {.is_done = true});
    (void)lines();
    grbl.abort("stopped by a person");
    EXPECT_THAT(lines(), ElementsAre("ALARM:3", "[MSG:stopped by a person]"));
    EXPECT_THAT(send("G0 X13\n"), ElementsAre("error:9"));
    EXPECT_THAT(send("\x18"), ElementsAre("", StartsWith("Grbl 1.1h"))) << "the place is known";
    change(MachinePhase::Idle);
    EXPECT_THAT(status(), StartsWith("<Idle|"));
}

TEST_F(Sender, IsTakenForOneAmongSeveralClients) {
    change(MachinePhase::Running);
    EXPECT_THAT(send("G0 X12\nG21\n"), ElementsAre("[MSG:another client's job is in progress]", "error:9", "ok"));
}

TEST_F(Sender, MayCheckAProgramWithoutMotion) {
    EXPECT_THAT(send("$C\nG1 X5 F100\nG2 X1\n"),
                ElementsAre("[MSG:Enabled]", "ok", "ok", StartsWith("[MSG:"), "error:20"));
    EXPECT_THAT(status(), StartsWith("<Check|"));
    EXPECT_THAT(send("$C\n"), ElementsAre("[MSG:Disabled]", "ok", "", StartsWith("Grbl")));
    EXPECT_THAT(asked(), ElementsAre());
}

}  // namespace
}  // namespace lockstep::grbl
