// Arcs, path modes and events of a program as the planner and the coordinator get them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/arc_path.hpp"
#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Kind = ProgramEvent::Kind;

GcodeSetup all_taken() {
    GcodeSetup setup = three_axes();
    setup.switches.ignore_unassigned = true;
    return setup;
}

std::vector<Block> blocks_of(std::string_view text, const GcodeSetup& setup = all_taken()) {
    auto program = parse_gcode(text, setup);
    if (program) { return program->blocks; }
    ADD_FAILURE() << program.error().front().line << ": " << program.error().front().message;
    return {};
}

std::string error_of(std::string_view text, const GcodeSetup& setup = all_taken()) {
    const auto program = parse_gcode(text, setup);
    return program ? "" : std::to_string(program.error().front().line) + ": " + program.error().front().message;
}

const ProgramMove& move(const Block& block) { return std::get<ProgramMove>(block.action); }

std::vector<ProgramEvent> events_of(std::string_view text, const GcodeSetup& setup = all_taken()) {
    std::vector<ProgramEvent> events;
    for (const Block& block : blocks_of(text, setup)) {
        if (const auto* event = std::get_if<ProgramEvent>(&block.action)) { events.push_back(*event); }
    }
    return events;
}

TEST(GcodeCurves, AnArcIsOneMoveAboutItsCentre) {
    const auto blocks = blocks_of("G0 X10 Y5\nG2 X20 Y15 I10 J0 F600\n");
    ASSERT_EQ(blocks.size(), 2U);
    EXPECT_THAT(move(blocks[1]).target_mm, ElementsAre(20, 15, 0));
    EXPECT_DOUBLE_EQ(move(blocks[1]).feed_mm_s, 10);
    const ArcShape arc{.first = 0, .second = 1, .centre_first_mm = 20, .centre_second_mm = 5, .is_clockwise = true};
    EXPECT_EQ(move(blocks[1]).arc, arc);
}

TEST(GcodeCurves, AHelixOfSeveralTurnsIsOneMove) {
    const auto blocks = blocks_of("G0 X10 Y10\nG3 X10 Y10 Z6 I5 P3 F600\n");
    ASSERT_EQ(blocks.size(), 2U);
    EXPECT_EQ(move(blocks[1]).arc->turns, 3);
    EXPECT_NEAR(ArcPath(*move(blocks[1]).arc, move(blocks[0]).target_mm, move(blocks[1]).target_mm).length_mm(),
                std::hypot(3 * 10 * 3.14159265358979, 6), 1e-6);
}

TEST(GcodeCurves, OtherPlanesNameTheirAxes) {
    const auto zx = blocks_of("G0 X10 Y5 Z5\nG18 G2 X20 Z5 I5 K0 F600\n");
    EXPECT_EQ(move(zx[1]).arc->first, 2U);
    EXPECT_EQ(move(zx[1]).arc->second, 0U);
    const auto yz = blocks_of("G0 X10 Y5 Z5\nG19 G2 Y15 Z5 J5 K0 F600\n");
    EXPECT_EQ(move(yz[1]).arc->first, 1U);
    EXPECT_EQ(move(yz[1]).arc->second, 2U);
}

TEST(GcodeCurves, AnArcInNoPlaneOfTwoAxesIsCutIntoChords) {
    const auto blocks = blocks_of("G10 L2 P1 R30\nG0 X10 Y5 Z5\nG18 G2 X20 Z5 I5 K0 F600\n");
    ASSERT_GT(blocks.size(), 20U);
    for (const Block& block : blocks) { EXPECT_FALSE(move(block).arc); }
}

TEST(GcodeCurves, ASplineBecomesArcsThatMeetInTheSameDirection) {
    const auto blocks = blocks_of("G0 X10 Y10\nG5 X60 Y10 I15 J30 P-15 Q30 F600\n");
    ASSERT_GT(blocks.size(), 20U);
    EXPECT_LT(blocks.size(), 600U);
    EXPECT_THAT(move(blocks.back()).target_mm, ElementsAre(60, 10, 0));
    double heading = std::atan2(30, 15);
    for (std::size_t i = 1; i < blocks.size(); ++i) {
        const ProgramMove& arc = move(blocks[i]);
        EXPECT_DOUBLE_EQ(arc.feed_mm_s, 10);
        ASSERT_TRUE(arc.arc) << i;
        const ArcPath path(*arc.arc, move(blocks[i - 1]).target_mm, arc.target_mm);
        EXPECT_NEAR(std::atan2(path.slope(1, 0), path.slope(0, 0)), heading, 1e-6) << i;
        heading = std::atan2(path.slope(1, 1), path.slope(0, 1));
    }
    EXPECT_NEAR(heading, -std::atan2(30, 15), 1e-6);
}

/// The number of arcs increases with the cube root of the inverse tolerance: here by a factor of 10.
TEST(GcodeCurves, ASplineBecomesFewerArcsWhereStepsAreLonger) {
    GcodeSetup fine = all_taken();
    fine.chord_tolerance_mm = 1e-5;
    GcodeSetup coarse = all_taken();
    coarse.chord_tolerance_mm = 1e-2;
    const std::string_view text = "G0 X10 Y10\nG5 X60 Y10 I15 J30 P-15 Q30 F600\n";
    EXPECT_GT(blocks_of(text, fine).size(), 5 * blocks_of(text, coarse).size());
}

TEST(GcodeCurves, AStraightSplineIsStraightMoves) {
    const auto blocks = blocks_of("G5 X30 Y30 I10 J10 P-10 Q-10 F600\n");
    ASSERT_EQ(blocks.size(), 2U);
    EXPECT_FALSE(move(blocks[0]).arc);
    EXPECT_THAT(move(blocks[1]).target_mm, ElementsAre(30, 30, 0));
}

TEST(GcodeCurves, ASplineWithAllItsPointsInOnePlaceIsNoMove) {
    EXPECT_TRUE(blocks_of("G5 X0 Y0 I0 J0 P0 Q0 F600\n").empty());
}

TEST(GcodeCurves, ASplineThatTouchesTheEndOfTheTravelIsTaken) {
    EXPECT_FALSE(blocks_of("G0 X10 Y190\nG5.1 X30 Y190 I10 J20 F600\n").empty());
    EXPECT_THAT(error_of("G0 X10 Y190\nG5.1 X30 Y190 I10 J20.01 F600\n"), HasSubstr("outside its travel"));
}

TEST(GcodeCurves, AnArcHasABoundedNumberOfTurns) {
    EXPECT_EQ(blocks_of("G0 X50 Y50\nG2 X50 Y50 I2 J0 P100000 F600\n").size(), 2U);
    EXPECT_THAT(error_of("G0 X50 Y50\nG2 X50 Y50 I2 J0 P100001 F600\n"),
                HasSubstr("must be a whole number from 1 to 100000"));
    EXPECT_THAT(error_of("G0 X50 Y50\nG2 X50 Y50 I2 J0 P0 F600\n"), HasSubstr("from 1 to 100000"));
}

/// The error is the only one: no chord was made.
TEST(GcodeCurves, RefusesAnArcOfTooManyChordsBeforeItIsCut) {
    GcodeSetup setup = all_taken();
    setup.curves_as_chords = true;
    setup.chord_tolerance_mm = 0.001;
    const auto read = parse_gcode("G0 X50 Y50\nG2 X50 Y50 I2 J0 P100000 F600\nG1 X51\n", setup);
    ASSERT_FALSE(read.has_value());
    ASSERT_EQ(read.error().size(), 1U);
    EXPECT_EQ(read.error()[0].line, 2);
    EXPECT_THAT(read.error()[0].message, HasSubstr("chords, but a program has at most 1000000 blocks"));
    EXPECT_TRUE(parse_gcode("G0 X50 Y50\nG2 X50 Y50 I2 J0 P100 F600\n", setup).has_value());
}

TEST(GcodeCurves, AMachineForStraightMovesGetsChords) {
    GcodeSetup setup = all_taken();
    setup.curves_as_chords = true;
    for (const char* text : {"G0 X10 Y5\nG2 X20 Y15 I10 J0 F600\n", "G0 X10 Y5\nG5.1 X30 Y5 I10 J20 F600\n"}) {
        const auto blocks = blocks_of(text, setup);
        EXPECT_GT(blocks.size(), 20U);
        for (const Block& block : blocks) { EXPECT_FALSE(move(block).arc); }
    }
}

TEST(GcodeCurves, AnArcThatLeavesTheTravelBetweenItsEndsIsRefused) {
    const std::string error = error_of("G0 X5 Y5\nG3 X5 Y25 I0 J10 F600\nG3 X5 Y5 I0 J-10\n");
    EXPECT_THAT(error, HasSubstr("3: "));
    EXPECT_THAT(error, HasSubstr("X to -5"));
}

TEST(GcodeModes, EachMoveHasThePathModeThatHolds) {
    const auto blocks = blocks_of("G1 X1 F600\nG61 X2\nG61.1 X3\nG64 P0.05 X4\nG64 X5\n");
    EXPECT_EQ(move(blocks[0]).mode, PathMode::Blend);
    EXPECT_EQ(move(blocks[1]).mode, PathMode::ExactPath);
    EXPECT_EQ(move(blocks[2]).mode, PathMode::ExactStop);
    EXPECT_EQ(move(blocks[3]).mode, PathMode::Blend);
    EXPECT_DOUBLE_EQ(move(blocks[3]).tolerance_mm, 0.05);
    EXPECT_DOUBLE_EQ(move(blocks[4]).tolerance_mm, 0);
}

TEST(GcodeModes, M49KeepsTheFeedWhateverTheOverride) {
    const auto blocks = blocks_of("G1 X1 F600\nM49\nX2\nM50 P1\nX3\nM50 P0\nX4\nM48\nX5\n");
    std::vector<bool> fixed;
    for (const Block& block : blocks) { fixed.push_back(move(block).is_feed_fixed); }
    EXPECT_THAT(fixed, ElementsAre(false, true, false, true, false));
}

TEST(GcodeEvents, StandBetweenTheMovesOfTheProgram) {
    const auto blocks = blocks_of("G1 X1 F600\nM3 S1200\nX2\nM8\nX3\nM9 M5\n");
    ASSERT_EQ(blocks.size(), 7U);
    EXPECT_EQ(std::get<ProgramEvent>(blocks[1].action), (ProgramEvent{.kind = Kind::SpindleForward, .value = 1200}));
    EXPECT_EQ(blocks[1].line, 2);
    EXPECT_EQ(std::get<ProgramEvent>(blocks[3].action).kind, Kind::FloodOn);
}

TEST(GcodeEvents, ASpeedCountsWhileTheSpindleTurns) {
    EXPECT_THAT(
        events_of("S500\nM4\nS800\nM5\nS900\n"),
        ElementsAre(ProgramEvent{.kind = Kind::SpindleReverse, .value = 500},
                    ProgramEvent{.kind = Kind::SpindleSpeed, .value = 800}, ProgramEvent{.kind = Kind::SpindleStop}));
}

TEST(GcodeEvents, OutputsHaveTheirNumberAndValue) {
    EXPECT_THAT(
        events_of("M62 P3\nM65 P3\nM67 E2 Q0.5\n"),
        ElementsAre(ProgramEvent{.kind = Kind::OutputOn, .index = 3}, ProgramEvent{.kind = Kind::OutputOff, .index = 3},
                    ProgramEvent{.kind = Kind::AnalogOutput, .index = 2, .value = 0.5}));
}

TEST(GcodeEvents, TheEndOfAProgramSwitchesOffWhatIsOn) {
    EXPECT_THAT(
        events_of("M3 S100\nM7\nM2\n"),
        ElementsAre(ProgramEvent{.kind = Kind::SpindleForward, .value = 100}, ProgramEvent{.kind = Kind::MistOn},
                    ProgramEvent{.kind = Kind::SpindleStop}, ProgramEvent{.kind = Kind::CoolantOff}));
    EXPECT_TRUE(events_of("G0 X1\nM2\n").empty());
}

TEST(GcodeEvents, AToolChangePausesOrGoesOnAsConfigured) {
    GcodeSetup setup = all_taken();
    const auto tool =
        ElementsAre(ProgramEvent{.kind = Kind::SpindleStop}, ProgramEvent{.kind = Kind::Tool, .index = 2});
    EXPECT_THAT(events_of("T2 M6\n", setup), tool);
    EXPECT_TRUE(std::holds_alternative<Pause>(blocks_of("T2 M6\n", setup).at(1).action));
    setup.unassigned.tool_change = ToolChange::GoOn;
    EXPECT_THAT(events_of("T2 M6\n", setup), tool);
    EXPECT_EQ(blocks_of("T2 M6\n", setup).size(), 2U);
}

TEST(GcodeEvents, TooManyWithoutAMoveBetweenThemAreRefused) {
    std::string text;
    for (int k = 0; k < 101; ++k) { text += "M9\n"; }
    EXPECT_THAT(error_of(text), HasSubstr("101: "));
}

}  // namespace
}  // namespace lockstep
