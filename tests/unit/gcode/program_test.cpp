// The program of a G-code text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

Program parse(std::string_view text, const GcodeSetup& setup = three_axes()) {
    auto program = parse_gcode(text, setup);
    if (program) { return *std::move(program); }
    ADD_FAILURE() << "line " << program.error().front().line << ": " << program.error().front().message;
    return {};
}

const ProgramMove& move(const Program& program, std::size_t i) {
    return std::get<ProgramMove>(program.blocks.at(i).action);
}

std::vector<double> last_target(std::string_view text, const GcodeSetup& setup = three_axes()) {
    const Program program = parse(text, setup);
    return program.blocks.empty() ? program.start_mm : move(program, program.blocks.size() - 1).target_mm;
}

TEST(Gcode, AProgramHasItsAxesAndItsStart) {
    GcodeSetup setup = three_axes();
    setup.axes[1].start_mm = 7;
    const Program program = parse("", setup);
    EXPECT_EQ(program.name, "example");
    EXPECT_THAT(program.axes, ElementsAre("X", "Y", "Z"));
    EXPECT_THAT(program.start_mm, ElementsAre(0, 7, 0));
    EXPECT_TRUE(program.blocks.empty());
}

TEST(Gcode, RapidsAndFeedsHaveAbsoluteTargetsAndTheirLine) {
    const Program program = parse("G0 X10 Y20\nG1 Z5 F600\n");
    ASSERT_EQ(program.blocks.size(), 2U);
    EXPECT_TRUE(move(program, 0).rapid);
    EXPECT_THAT(move(program, 0).target_mm, ElementsAre(10, 20, 0));
    EXPECT_FALSE(move(program, 1).rapid);
    EXPECT_THAT(move(program, 1).target_mm, ElementsAre(10, 20, 5));
    EXPECT_DOUBLE_EQ(move(program, 1).feed_mm_s, 10);
    EXPECT_EQ(program.blocks[0].line, 1);
    EXPECT_EQ(program.blocks[1].line, 2);
}

TEST(Gcode, MotionFeedUnitsAndDistanceModesLast) {
    const Program program = parse("G20 G91 G1 F60 X1\nX1 Y1\n");
    EXPECT_THAT(move(program, 1).target_mm, ElementsAre(50.8, 25.4, 0));
    EXPECT_DOUBLE_EQ(move(program, 1).feed_mm_s, 25.4);
}

TEST(Gcode, AFeedOutlivesAChangeOfUnits) {
    const Program program = parse("G20 G1 F60 X1\nG21 X10\n");
    EXPECT_DOUBLE_EQ(move(program, 1).feed_mm_s, 25.4);
}

TEST(Gcode, TheModalMotionContinuesAfterDwellAndG28) {
    const Program program = parse("G1 F600 X50\nG4 P0.5 X60\nG28 Z0\nX70\n");
    ASSERT_EQ(program.blocks.size(), 5U);
    EXPECT_DOUBLE_EQ(std::get<Dwell>(program.blocks[1].action).seconds, 0.5);
    EXPECT_FALSE(move(program, 2).rapid);
    EXPECT_TRUE(move(program, 3).rapid);
    EXPECT_FALSE(move(program, 4).rapid);
    EXPECT_THAT(move(program, 4).target_mm, ElementsAre(70, 0, 5));
}

TEST(Gcode, RelativeMovesAddUpAndAbsoluteOnesComeBack) {
    EXPECT_THAT(last_target("G91 G0 X10\nX10\nX-5 Y3\n"), ElementsAre(15, 3, 0));
    EXPECT_THAT(last_target("G91 G0 X10\nG90 X4\n"), ElementsAre(4, 0, 0));
}

TEST(Gcode, ManyRelativeMovesToTheLimitStayInside) {
    std::string text = "G91 G0\n";
    for (int i = 0; i < 2000; ++i) { text += "X.1\n"; }
    EXPECT_LE(last_target(text).front(), 200);
    EXPECT_THAT(last_target(text).front(), DoubleNear(200, 1e-6));
}

TEST(Gcode, G92NamesThePlaceWhereTheAxesStandAndG92Point1TakesItBack) {
    EXPECT_THAT(last_target("G0 X50\nG92 X0 Y10\nX10 Y10\n"), ElementsAre(60, 0, 0));
    EXPECT_THAT(last_target("G0 X50\nG92 X0\nG92.1\nX10\n"), ElementsAre(10, 0, 0));
    EXPECT_THAT(last_target("G0 X50\nG20 G92 X1\nX2\n"), ElementsAre(75.4, 0, 0));
}

TEST(Gcode, G28ParksAllAxesOrThoseNamedThroughThePointNamed) {
    EXPECT_THAT(last_target("G0 X50 Y60\nG28\n"), ElementsAre(5, 5, 5));
    const Program program = parse("G0 X50 Y60\nG28 X40\n");
    EXPECT_THAT(move(program, 1).target_mm, ElementsAre(40, 60, 0));
    EXPECT_THAT(move(program, 2).target_mm, ElementsAre(5, 60, 0));
    EXPECT_TRUE(move(program, 1).rapid && move(program, 2).rapid);
    EXPECT_EQ(parse("G0 X50 Z9\nG91 G28 Z0\n").blocks.size(), 2U) << "the named point is its position";
}

TEST(Gcode, OffsetsDoNotMoveThePark) { EXPECT_THAT(last_target("G92 X50\nG28 X50\n").front(), 5); }

TEST(Gcode, M0PausesAndM1OnlyWithOptionalStop) {
    GcodeSetup setup = three_axes();
    EXPECT_EQ(parse("M0\nM1\n", setup).blocks.size(), 1U);
    setup.switches.pause_at_m1 = true;
    const Program program = parse("M0\nM1\n", setup);
    ASSERT_EQ(program.blocks.size(), 2U);
    EXPECT_TRUE(std::holds_alternative<Pause>(program.blocks[1].action));
}

Pause pause_of(std::string_view text) {
    GcodeSetup setup = three_axes();
    setup.switches.pause_at_m1 = true;
    for (const Block& block : parse(text, setup).blocks) {
        if (const auto* pause = std::get_if<Pause>(&block.action)) { return *pause; }
    }
    return {.text = "no pause"};
}

TEST(Gcode, APauseCarriesItsReasonToolAndText) {
    EXPECT_EQ(pause_of("M0\n"), (Pause{PauseReason::ProgramStop, 0, ""}));
    EXPECT_EQ(pause_of("M1\n"), (Pause{PauseReason::OptionalStop, 0, ""}));
    EXPECT_EQ(pause_of("M60\n"), (Pause{PauseReason::PalletChange, 0, ""}));
    EXPECT_EQ(pause_of("T2 M6\n"), (Pause{PauseReason::ToolChange, 2, ""}));
    EXPECT_EQ(pause_of("M0 (turn the part over)\n").text, "turn the part over");
    EXPECT_EQ(pause_of("(MSG, turn the part over)\nG0 X1\nM0\n").text, "turn the part over");
    EXPECT_EQ(pause_of("(MSG, turn it)\nM0 (comment, with a comma)\n").text, "comment, with a comma");
    EXPECT_EQ(pause_of("(drill the holes)\nM0\n").text, "") << "a comment on another line is not about the pause";
}

TEST(Gcode, AToolChangeNamesTheToolByTheProgramsComments) {
    EXPECT_EQ(pause_of("T2 M6 (6 mm end mill)\n").text, "6 mm end mill");
    EXPECT_EQ(pause_of("(T1 3 mm drill)\n(T2  D=6. - flat end mill)\nT2 M6\n").text, "D=6. - flat end mill");
    EXPECT_EQ(pause_of("(T1 3 mm drill)\nT2 M6\n").text, "");
    EXPECT_EQ(pause_of("(Two passes)\n(T)\n(T2x)\n(T2)\nT2 M6\n").text, "");
}

TEST(Gcode, AMessageIsOfOnePause) {
    const Program program = parse("(MSG, first)\nM0\nG0 X1\nM0\n", three_axes());
    EXPECT_EQ(std::get<Pause>(program.blocks[0].action).text, "first");
    EXPECT_EQ(std::get<Pause>(program.blocks[2].action).text, "");
}

TEST(Gcode, AMotionInAStopsBlockComesFirst) {
    const Program program = parse("G0 X1 M0\n");
    ASSERT_EQ(program.blocks.size(), 2U);
    EXPECT_TRUE(std::holds_alternative<Pause>(program.blocks[1].action));
}

TEST(Gcode, NothingAfterTheEndIsRead) {
    for (const char* end : {"M2", "M30", "%"}) {
        EXPECT_EQ(parse(std::string("%\nG0 X1\n") + end + "\nG0 X9999 \xff (\n").blocks.size(), 1U) << end;
    }
    EXPECT_EQ(parse("(made by hand)\n%\nG0 X1\n").blocks.size(), 1U) << "the first % opens the tape";
}

TEST(Gcode, TheLineNumberIsTheTextsAndNotTheWordN) {
    const Program program = parse("\r\n; outline\r\nN500 G0 X1\r\n");
    EXPECT_EQ(program.blocks.at(0).line, 3);
}

TEST(Gcode, SpacesCommentsAndSmallLettersAreAllOne) {
    const std::vector<double> place = last_target("G1 F600 X12.5 Y-0.0 Z3\n");
    EXPECT_EQ(last_target("g1f600x12.5y-0.z3"), place);
    EXPECT_EQ(last_target("  G 0 1 F 6 0 0 (across) X +1 2 . 5 Y-.0 Z\t3 ; and down"), place);
    EXPECT_EQ(last_target("n10 g1.0 f600 (\xc3\x98 6 mm) x012.50 y0 z3."), place);
}

TEST(Gcode, ALineThatBeginsWithASlashRunsOnlyOnRequest) {
    GcodeSetup setup = three_axes();
    EXPECT_EQ(parse("/G0 X1\n / N5 Q1 G0 X1\n", setup).blocks.size(), 0U);
    setup.switches.skip_deletable = false;
    EXPECT_EQ(parse("/G0 X1\n", setup).blocks.size(), 1U);
}

TEST(Gcode, AMoveToTheAxesPositionIsLeftOut) { EXPECT_EQ(parse("G0 X10\nG0 X10\nG0\n").blocks.size(), 1U); }

TEST(Gcode, TheFeedIsThatOfTheLinearAxesAndOfTheRotaryOnesAlone) {
    GcodeSetup setup = three_axes();
    setup.axes[2] = {.name = "A", .min_mm = -360, .max_mm = 360, .park_mm = 0, .start_mm = 0};
    const Program program = parse("G20 G1 F60 X1\nA90\nX2 A120\n", setup);
    EXPECT_DOUBLE_EQ(move(program, 0).feed_mm_s, 25.4);
    EXPECT_THAT(move(program, 1).target_mm, ElementsAre(25.4, 0, 90)) << "degrees are never inches";
    EXPECT_DOUBLE_EQ(move(program, 1).feed_mm_s, 1);
    EXPECT_DOUBLE_EQ(std::hypot(25.4, 30) / move(program, 2).feed_mm_s, 1) << "one inch at an inch a second";
}

TEST(Gcode, AxesOfLongerNamesRestWhereTheyAre) {
    GcodeSetup setup = three_axes();
    setup.axes[2].name = "left";
    setup.axes[2].start_mm = 20;
    EXPECT_THAT(last_target("G0 X1\n", setup), ElementsAre(1, 0, 20));
    EXPECT_THAT(last_target("G28\n", setup), ElementsAre(5, 5, 20));
}

}  // namespace
}  // namespace lockstep
