// Cutter compensation: the path of the tool's centre beside the path of the program.
#include <gmock/gmock.h>

#include <cmath>

#include "core/gcode/gcode.hpp"
#include "tests/unit/gcode/actions.hpp"

namespace lockstep::gcode {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::SizeIs;

constexpr double kClose = 1e-9;

testing::Matcher<Point> is_at(double x, double y, double z = 0) {
    return ElementsAre(DoubleNear(x, kClose), DoubleNear(y, kClose), DoubleNear(z, kClose), 0, 0, 0, 0, 0, 0);
}

std::vector<Point> ends(std::string_view text) {
    const Ran ran = run(text);
    EXPECT_FALSE(ran.error) << ran.error->line << ": " << ran.error->message;
    std::vector<Point> found;
    for (const Action& action : ran.actions) {
        if (const auto* straight = std::get_if<Straight>(&action)) { found.push_back(straight->target); }
        if (const auto* arc = std::get_if<Arc>(&action)) { found.push_back(arc->target); }
    }
    return found;
}

std::string error_of(std::string_view text) {
    const Ran ran = run(text);
    return ran.error ? std::to_string(ran.error->line) + ": " + ran.error->message : "";
}

TEST(GcodeCompensation, EntryMoveEndsARadiusBesideItsEnd) {
    EXPECT_THAT(ends("F9 G41.1 D2\nG1 X10\n"), ElementsAre(is_at(10, 1)));
    EXPECT_THAT(ends("F9 G42.1 D2\nG1 X10\n"), ElementsAre(is_at(10, -1)));
    EXPECT_THAT(ends("F9 G41 D1\nG1 X10\n"), ElementsAre(is_at(10, 1.5)));
    EXPECT_THAT(ends("F9 T2 M6\nG41\nG1 X10\n"), ElementsAre(is_at(10, 3)));
    EXPECT_THAT(ends("F9 G41.1 D-2\nG1 X10\n"), ElementsAre(is_at(10, -1)));
}

TEST(GcodeCompensation, EntryArcReachesItsEndInTheProgrammedDirection) {
    const Ran ran = run("F9 G41.1 D2\nG2 X10 Y10 J10\n");
    const auto arcs = ran.all<Arc>();
    ASSERT_THAT(arcs, SizeIs(1));
    EXPECT_THAT(arcs[0].target, is_at(11, 10));
    EXPECT_THAT(arcs[0].centre, ElementsAre(DoubleNear(21.0 / 22, kClose), DoubleNear(10, kClose), 0));
}

TEST(GcodeCompensation, InsideCornerIsCutShort) {
    EXPECT_THAT(ends("F9 G41.1 D2\nG1 X10\nX20\nY10\nG40\nX0\n"),
                ElementsAre(is_at(10, 1), is_at(19, 1), is_at(19, 10), is_at(0, 10)));
}

TEST(GcodeCompensation, OutsideCornerIsRoundedAboutTheCorner) {
    const Ran ran = run("F9 G42.1 D2\nG1 X10\nX20\nY10\n");
    const auto arcs = ran.all<Arc>();
    ASSERT_THAT(arcs, SizeIs(1));
    EXPECT_THAT(arcs[0].target, is_at(21, 0));
    EXPECT_THAT(arcs[0].centre, ElementsAre(20, 0, 0));
    EXPECT_EQ(arcs[0].turns, 1);
}

TEST(GcodeCompensation, RapidMoveLeadsAroundAnOutsideCornerStraight) {
    EXPECT_THAT(ends("F9 G42.1 D2\nG1 X10\nX20\nG0 Y10\n"),
                ElementsAre(is_at(10, -1), is_at(20, -1), is_at(21, 0), is_at(21, 10)));
}

TEST(GcodeCompensation, PathThatTurnsBackLeadsAroundItsEnd) {
    const Ran ran = run("F9 G41.1 D2\nG1 X10\nX20\nX0\n");
    ASSERT_THAT(ran.all<Arc>(), SizeIs(1));
    EXPECT_THAT(ran.all<Arc>()[0].target, is_at(20, -1));
}

TEST(GcodeCompensation, ArcsChangeTheirRadiusAndMeetAtInsideCorners) {
    const Ran ran = run("F9 G41.1 D2\nG1 X10\nG2 X20 I5\nG1 Y-10\n");
    const auto arcs = ran.all<Arc>();
    ASSERT_THAT(arcs, SizeIs(1));
    EXPECT_THAT(ran.all<Straight>()[0].target, is_at(15 - std::sqrt(35), 1));
    EXPECT_THAT(arcs[0].target, is_at(21, 0));
    EXPECT_THAT(arcs[0].centre, ElementsAre(15, 0, 0));
}

TEST(GcodeCompensation, PlaneOfG18IsSeenFromTheTipOfY) {
    EXPECT_THAT(ends("F9 G18 G41.1 D2\nG1 X10\n"), ElementsAre(is_at(10, 0, -1)));
    EXPECT_THAT(ends("F9 G18 G41.1 D2 L3\nG1 X10\n"), ElementsAre(is_at(11, 0, -2)));
}

TEST(GcodeCompensation, MovesAcrossThePlaneKeepTheCornerBeforeThem) {
    EXPECT_THAT(ends("F9 G41.1 D2\nG1 X10\nX20\nZ5\nY10\n"),
                ElementsAre(is_at(10, 1), is_at(19, 1), is_at(19, 1, 5), is_at(19, 10, 5)));
}

TEST(GcodeCompensation, EventsKeepTheirPlaceOnThePath) {
    const Ran ran = run("F9 G41.1 D2\nG1 X10\nX20\nM0\nY10\n");
    ASSERT_THAT(ran.actions, SizeIs(4));
    EXPECT_TRUE(std::holds_alternative<Event>(ran.actions[2]));
    EXPECT_THAT(std::get<Straight>(ran.actions[1]).target, is_at(19, 1));
}

TEST(GcodeCompensation, FirstMoveAfterG40LeadsBackToThePath) {
    EXPECT_THAT(ends("F9 G41.1 D2\nG1 X10\nX20\nG40\nG0 Z5\n"),
                ElementsAre(is_at(10, 1), is_at(20, 1), is_at(20, 0, 5)));
    EXPECT_THAT(error_of("F9 G41.1 D2\nG1 X10\nG40\nG2 X20 I5\n"), HasSubstr("4: G2 is the first motion after"));
}

TEST(GcodeCompensation, FeedOfTheMoveBackIsOfThePlanesAxes) {
    const Ran ran = run("F9 G41.1 D2\nG1 X10\nG40\nG20 F2\nA90\n");
    ASSERT_THAT(ran.all<Straight>(), SizeIs(2));
    EXPECT_DOUBLE_EQ(ran.all<Straight>()[1].feed, 50.8);
}

TEST(GcodeCompensation, ProgramThatEndsBesideItsPathLeavesTheAxesThere) {
    EXPECT_THAT(end_of("F9 G41.1 D2\nG1 X10\nM2\n"), is_at(10, 1));
    EXPECT_THAT(end_of("F9 G41.1 D2\nG1 X10\n"), is_at(10, 1));
}

TEST(GcodeCompensation, MotionsThatTheToolCannotReachAreRefused) {
    EXPECT_THAT(error_of("F9 G41.1 D2\nG1 X1\n"), HasSubstr("longer than the tool's radius, 1 mm"));
    EXPECT_THAT(error_of("F9 G41.1 D2\nG1 X10\nX10.5\nY10\n"), HasSubstr("4: G1 makes a corner"));
    EXPECT_THAT(error_of("F9 G41.1 D2\nG1 X10\nX20\nY0.5\nX30\n"), HasSubstr("makes a corner"));
    EXPECT_THAT(error_of("F9 G41.1 D2\nG1 X10\nY2\nG3 X8 I-1\n"), HasSubstr("has a radius of 1 mm"));
}

TEST(GcodeCompensation, ProgramIsReadOnWithoutItAfterARefusedMotion) {
    const auto program =
        parse_gcode("G42.1 D6\nG1 X0 Y0 F3000\nX70\nY40\nG0 X-15 Y-15\nG1 X0 Y0\nY-10\nG40\nX10 Y10\nX900\n",
                    {.program_name = "any", .axes = {{"X", -50, 200}, {"Y", -50, 200, 0, 10}}});
    ASSERT_FALSE(program);
    EXPECT_THAT(program.error(), ElementsAre(Field(&GcodeError::message, HasSubstr("makes a corner")),
                                             Field(&GcodeError::message, HasSubstr("X900"))));
}

TEST(GcodeCompensation, WordsThatDoNotGoWithItAreRefused) {
    for (const char* words :
         {"G53 G0 X1", "G28", "G28.1", "G55", "G54", "G92 X1", "G10 L2 P1 X1", "G49", "M6", "M61 Q1", "G18", "G61",
          "M64 P1", "M48", "G81 Z-1 R1", "G5.1 X9 I1 J1", "G41", "G42.1 D1"}) {
        EXPECT_NE(error_of("F9 G41.1 D2\nG1 X10\n" + std::string(words) + "\n"), "") << words;
    }
    EXPECT_THAT(error_of("G19 G41.1 D2\n"), HasSubstr("plane of Y and Z"));
    EXPECT_THAT(error_of("G41.1\n"), HasSubstr("needs D"));
    EXPECT_THAT(error_of("G18 G41.1 D2 L3\nG2 X9 Z9 K9 F9\n"), HasSubstr("begin with a straight motion"));
    EXPECT_THAT(error_of("G41 D9\n"), HasSubstr("tool 9 is not in the tool table"));
}

}  // namespace
}  // namespace lockstep::gcode
