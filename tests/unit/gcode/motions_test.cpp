// The motions of a text: arcs, splines, cycles and offsets.
#include <gmock/gmock.h>

#include <cmath>

#include "core/gcode/curves/chords.hpp"
#include "tests/unit/gcode/actions.hpp"

namespace lockstep::gcode {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::SizeIs;

Arc only_arc(std::string_view text) {
    const Ran ran = run(text);
    const auto arcs = ran.all<Arc>();
    EXPECT_THAT(arcs, SizeIs(1)) << (ran.error ? ran.error->message : "");
    return arcs.empty() ? Arc{} : arcs.front();
}

TEST(GcodeArcs, HaveTheCentreThatTheOffsetsGive) {
    const Arc arc = only_arc("G2 X2 I1 F10");
    EXPECT_THAT(arc.centre, ElementsAre(1, 0, 0));
    EXPECT_THAT(arc.axis, ElementsAre(0, 0, 1));
    EXPECT_EQ(arc.turns, -1);
    EXPECT_DOUBLE_EQ(arc.feed, 10);
}

TEST(GcodePolar, BlocksOwnG91CountsBeforeItsCoordinates) {
    const Point end = end_of("G0 X3 Y4\nG91 G0 @5 ^0\n");
    EXPECT_NEAR(end[0], 6, 1e-12);
    EXPECT_NEAR(end[1], 8, 1e-12);
}

TEST(GcodeArcs, ByRadiusAreTheShortOrTheLongWay) {
    EXPECT_THAT(only_arc("G2 X2 Y2 R2 F1").centre, ElementsAre(DoubleNear(2, 1e-12), DoubleNear(0, 1e-12), 0));
    EXPECT_THAT(only_arc("G2 X2 Y2 R-2 F1").centre, ElementsAre(DoubleNear(0, 1e-12), DoubleNear(2, 1e-12), 0));
}

TEST(GcodeArcs, OfTheOtherPlanesTurnAboutTheirNormals) {
    EXPECT_THAT(only_arc("G18 G2 X2 I1 F1").axis, ElementsAre(0, 1, 0));
    EXPECT_THAT(only_arc("G19 G3 Y2 J1 F1").axis, ElementsAre(1, 0, 0));
}

TEST(GcodeArcs, OfInchesAreInMillimetres) {
    const Arc arc = only_arc("G20 G2 X2 I1 F1");
    EXPECT_THAT(arc.centre, ElementsAre(25.4, 0, 0));
    EXPECT_DOUBLE_EQ(arc.target[0], 50.8);
    EXPECT_DOUBLE_EQ(arc.feed, 25.4);
}

std::string arc_with_radii(const char* units, double begin, double end) {
    return std::string(units) + " G2 X" + std::to_string(begin) + " Y" + std::to_string(end) + " I" +
           std::to_string(begin) + " F100\n";
}

TEST(GcodeArcs, MayHaveRadiiThatDifferAsMuchAsInLinuxCnc) {
    struct Radii {
        const char* units;
        double begin;
        double most;
        double more;
    };
    for (const Radii& radii :
         {Radii{"G21", 25, 25.028, 25.0284}, Radii{"G21", 25, 24.972, 24.9716}, Radii{"G21", 1270, 1271.27, 1271.28},
          Radii{"G21", 4000, 4002.82, 4002.84}, Radii{"G20", 1, 1.0028, 1.0029}, Radii{"G20", 50, 50.05, 50.051},
          Radii{"G20", 400, 400.28, 400.285}, Radii{"G21", 0.02, 0.0013, 0.0012}}) {
        const Arc arc = only_arc(arc_with_radii(radii.units, radii.begin, radii.most));
        const double mm = radii.units == std::string_view("G20") ? 25.4 : 1;
        EXPECT_DOUBLE_EQ(arc.target[1], radii.most * mm) << "the programmed end";
        EXPECT_FALSE(run(arc_with_radii(radii.units, radii.begin, radii.more)).error == std::nullopt) << radii.more;
    }
    EXPECT_THAT(run(arc_with_radii("G21", 25, 25.03)).error->message,
                testing::HasSubstr("25 mm at the start and 25.03 mm at the end, which may differ by 0.0283 mm"));
}

/// The greatest distance of chords' ends and middles from a circle about (0, 0).
double greatest_error(const std::vector<Point>& ends, Point from, double radius) {
    double error = 0;
    for (const Point& end : ends) {
        const double middle = std::hypot((from[0] + end[0]) / 2, (from[1] + end[1]) / 2);
        error = std::max({error, std::abs(std::hypot(end[0], end[1]) - radius), std::abs(middle - radius)});
        from = end;
    }
    return error;
}

TEST(GcodeChords, OfAnArcStayWithinTheTolerance) {
    for (const double tolerance : {0.1, 0.01, 0.0005}) {
        Arc arc{.target = {0, 10, 3}, .centre = {}, .axis = {0, 0, 1}, .turns = 2, .feed = 1};
        std::vector<Point> ends;
        const Point from{10, 0, 0};
        cut(arc, from, tolerance, [&](const Point& end) { ends.push_back(end); });
        const double error = greatest_error(ends, from, 10);
        EXPECT_LE(error, tolerance * 1.0001);
        EXPECT_GT(error, tolerance / 3) << "and are not many more than needed";
        EXPECT_EQ(ends.back(), arc.target);
    }
}

TEST(GcodeChords, OfASplineEndAtItsTargetAndPassItsMiddle) {
    const Ran ran = run("G5.1 I1 J2 X2 Y0 F10");
    const auto splines = ran.all<Spline>();
    ASSERT_THAT(splines, SizeIs(1));
    double highest = 0;
    Point last{};
    cut(splines[0], {}, 0.001, [&](const Point& end) {
        highest = std::max(highest, end[1]);
        last = end;
    });
    EXPECT_THAT(highest, DoubleNear(1, 0.001)) << "half as high as the control point";
    EXPECT_EQ(last, splines[0].target);
}

TEST(GcodeChords, OfANurbsOfACircleAreOnTheCircle) {
    const Ran ran = run("G0 X1\nG5.2 X1 Y1 P0.707106781186547 L3 F1\nX0 Y1 P1\nG5.3\n");
    const auto splines = ran.all<Spline>();
    ASSERT_THAT(splines, SizeIs(1)) << (ran.error ? ran.error->message : "");
    std::vector<Point> ends;
    cut(splines[0], {1, 0, 0}, 1e-4, [&](const Point& end) { ends.push_back(end); });
    EXPECT_LE(greatest_error(ends, {1, 0, 0}, 1), 1e-4);
}

/// The targets of the straight moves: x, y and z of each.
std::vector<std::array<double, 3>> places(std::string_view text) {
    std::vector<std::array<double, 3>> result;
    const Ran ran = run(text);
    EXPECT_FALSE(ran.error) << ran.error->message;
    for (const Straight& move : ran.all<Straight>()) {
        result.push_back({move.target[0], move.target[1], move.target[2]});
    }
    return result;
}

TEST(GcodeCycles, DrillAndRetractToR) {
    using P = std::array<double, 3>;
    EXPECT_THAT(places("G0 Z10\nG81 X1 Y1 Z-5 R2 F10\nX2\nG80\n"),
                ElementsAre(P{0, 0, 10}, P{1, 1, 10}, P{1, 1, 2}, P{1, 1, -5}, P{1, 1, 2}, P{2, 1, 2}, P{2, 1, -5},
                            P{2, 1, 2}));
}

TEST(GcodeCycles, RetractToTheStartWithG98) {
    EXPECT_THAT(places("G0 Z10\nG98 G81 X1 Z-5 R2 F10\n").back(), ElementsAre(1, 0, 10));
}

TEST(GcodeCycles, RepeatAroundTheZeroInPolarCoordinates) {
    std::vector<std::pair<double, double>> holes;
    for (const auto& place : places("G0 X10 Z1\nG91 G81 R0 Z-2 ^90 L3 F10\n")) {
        if (place[2] < 0) { holes.emplace_back(std::round(place[0]), std::round(place[1])); }
    }
    EXPECT_THAT(holes, ElementsAre(std::pair(0, 10), std::pair(-10, 0), std::pair(0, -10)));
    EXPECT_NEAR(end_of("G0 X10 Z1\nG91 G81 R0 Z-2 @5 L3 F10\n")[0], 25, 1e-9);
}

TEST(GcodeCycles, PeckWithClearance) {
    using P = std::array<double, 3>;
    EXPECT_THAT(places("G0 Z2\nG83 Z-1 R2 Q2 F1\n"),
                ElementsAre(P{0, 0, 2}, P{0, 0, 0}, P{0, 0, 2}, P{0, 0, 0.254}, P{0, 0, -1}, P{0, 0, 2}));
    EXPECT_THAT(places("G0 Z2\nG73 Z-1 R2 Q2 F1\n"),
                ElementsAre(P{0, 0, 2}, P{0, 0, 0}, P{0, 0, 0.254}, P{0, 0, -1}, P{0, 0, 2}));
}

TEST(GcodeOffsets, CoordinateSystemsMoveTheZero) {
    EXPECT_DOUBLE_EQ(end_of("G10 L2 P2 X5\nG55 G0 X1\n")[0], 6);
    EXPECT_DOUBLE_EQ(end_of("G10 L2 P1 X5\nG0 X1\n")[0], 6);
    EXPECT_DOUBLE_EQ(end_of("G0 X7\nG10 L20 P1 X1\nG0 X0\n")[0], 6);
    EXPECT_DOUBLE_EQ(end_of("G0 X7\nG10 L20 P2 X1\nG55 G0 X0\n")[0], 6);
    const Point turned = end_of("G10 L2 P2 X3 Y2 R90\nG0 X3 Y12\nG10 L20 P2 X4\nG55 G0 X0 Y0\n");
    EXPECT_NEAR(turned[0], 3, 1e-9) << "its Y, which is 0 there, stays";
    EXPECT_NEAR(turned[1], 8, 1e-9);
    EXPECT_DOUBLE_EQ(end_of("G10 L2 P9 X2\nG59.3 G0 X1\nG53 G0 X1\n")[0], 1);
}

TEST(GcodeOffsets, ARotationTurnsXAndY) {
    const Point end = end_of("G10 L2 P1 R90\nG0 X2 Y1\n");
    EXPECT_THAT(end[0], DoubleNear(-1, 1e-12));
    EXPECT_THAT(end[1], DoubleNear(2, 1e-12));
}

TEST(GcodeOffsets, ToolLengthsAddUp) {
    EXPECT_DOUBLE_EQ(end_of("G43 H1\nG0 Z0\n")[2], 2);
    EXPECT_DOUBLE_EQ(end_of("G43 H1\nG43.2 H2\nG0 Z0\n")[2], 7);
    EXPECT_DOUBLE_EQ(end_of("G43.1 Z3\nG0 Z1\nG49\nG0 Z1\n")[2], 1);
}

TEST(GcodeOffsets, G28GoesWhereG28Point1WasGiven) {
    EXPECT_DOUBLE_EQ(end_of("G0 X3\nG28.1\nG0 X9\nG92 X0\nG28\n")[0], 3);
}

TEST(GcodePolar, DistanceAndAngleGiveXAndY) {
    const Point end = end_of("G0 @10 ^30\n");
    EXPECT_THAT(end[0], DoubleNear(10 * std::sqrt(3.0) / 2, 1e-12));
    EXPECT_THAT(end[1], DoubleNear(5, 1e-12));
}

TEST(GcodeFeed, InverseTimeIsByTheLengthOfTheMove) {
    const auto moves = run("G93 G1 X10 F2\nX30 F1\n").all<Straight>();
    ASSERT_THAT(moves, SizeIs(2));
    EXPECT_DOUBLE_EQ(moves[0].feed, 20);
    EXPECT_DOUBLE_EQ(moves[1].feed, 20);
}

}  // namespace
}  // namespace lockstep::gcode
