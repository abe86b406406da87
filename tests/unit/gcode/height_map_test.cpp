// Height maps: which are taken, their heights, and programs that are bent by them.
#include "core/gcode/curves/height_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/gcode/gcode.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr double kTolerance_mm = 0.002;

double surface(double x, double y) { return 40 + 0.02 * x - 0.01 * y + 0.0004 * x * y; }

/// From 10 to 50 by 10 in X, and from 0 to 60 by 20 in Y.
std::vector<HeightPoint> points() {
    std::vector<HeightPoint> grid;
    for (double y = 0; y <= 60; y += 20) {
        for (double x = 10; x <= 50; x += 10) { grid.push_back({x, y, surface(x, y)}); }
    }
    return grid;
}

HeightMap map() { return HeightMap::make(points()).value(); }

std::string map_error(const std::vector<HeightPoint>& points) {
    const auto made = HeightMap::make(points);
    return made ? "" : made.error().text();
}

TEST(HeightMap, IsBilinearBetweenItsPointsAndZeroAtTheFirst) {
    const HeightMap heights = map();
    EXPECT_EQ(heights.height_mm(10, 0), 0);
    EXPECT_NEAR(heights.height_mm(33.3, 47.1), surface(33.3, 47.1) - surface(10, 0), 1e-12);
    EXPECT_NEAR(heights.height_mm(50, 60), surface(50, 60) - surface(10, 0), 1e-12);
    EXPECT_NEAR(heights.height_mm(0, 70), heights.height_mm(10, 60), 1e-12) << "beyond its edges as at them";
}

TEST(HeightMap, TakesItsPointsInAnyOrder) {
    std::vector<HeightPoint> turned = points();
    std::ranges::reverse(turned);
    EXPECT_EQ(HeightMap::make(turned)->height_mm(33, 47), map().height_mm(33, 47));
}

TEST(HeightMap, ThatIsNoWholeGridIsRefused) {
    std::vector<HeightPoint> grid = points();
    grid.erase(grid.begin() + 7);
    EXPECT_THAT(map_error(grid), HasSubstr("no point at X 30 Y 20"));
    grid = points();
    grid.push_back(grid[3]);
    EXPECT_THAT(map_error(grid), HasSubstr("two points at X 40 Y 0"));
    EXPECT_THAT(map_error({{0, 0, 0}, {10, 0, 0}}), HasSubstr("two lines or more"));
    EXPECT_THAT(map_error({}), HasSubstr("two lines or more"));
    EXPECT_THAT(map_error(std::vector<HeightPoint>(HeightMap::kMostPoints + 1)), HasSubstr("at most 10000"));
}

TEST(HeightMap, ThatIsTooSteepIsRefusedWithItsPlace) {
    std::vector<HeightPoint> grid = points();
    grid[8].z_mm += 5;
    EXPECT_THAT(map_error(grid), HasSubstr("X 40 Y 0"));
    EXPECT_THAT(map_error(grid), HasSubstr("may rise or fall by 0.2"));
}

GcodeSetup setup(bool bent = true) {
    GcodeSetup setup{.program_name = "bent", .axes = {}, .chord_tolerance_mm = kTolerance_mm};
    for (const char* name : {"X", "Y", "Z"}) {
        setup.axes.push_back({.name = name, .min_mm = -20, .max_mm = 100, .park_mm = 0, .start_mm = 20});
    }
    if (bent) { setup.switches.heights = std::make_shared<const HeightMap>(map()); }
    return setup;
}

std::vector<std::vector<double>> targets_of(const std::string& text, const GcodeSetup& setup) {
    const auto program = parse_gcode(text, setup);
    EXPECT_TRUE(program) << program.error().front().message;
    std::vector<std::vector<double>> targets;
    if (!program) { return targets; }
    for (const Block& block : program->blocks) {
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) { targets.push_back(move->target_mm); }
    }
    return targets;
}

/// The greatest distance in Z of any point of the moves from the level z above the surface.
double deviation(std::vector<double> from, const std::vector<std::vector<double>>& targets, double level) {
    double greatest = 0;
    for (const std::vector<double>& to : targets) {
        for (int i = 0; i <= 20; ++i) {
            const auto at = [&](std::size_t axis) { return from[axis] + i / 20.0 * (to[axis] - from[axis]); };
            const double wanted = level + surface(at(0), at(1)) - surface(10, 0);
            greatest = std::max(greatest, std::abs(at(2) - wanted));
        }
        from = to;
    }
    return greatest;
}

TEST(BentProgram, FollowsTheSurfaceOnLines) {
    for (const char* text : {"G1 F600 X50 Y60", "G1 F600 X20 Y60", "G1 F600 X10.5 Y0.3", "G0 X50 Y0\nG1 F60 X12 Y58"}) {
        const auto targets = targets_of(text, setup());
        const double start_level = 20 - (surface(20, 20) - surface(10, 0));
        EXPECT_LE(deviation({20, 20, 20}, targets, start_level), kTolerance_mm) << text;
    }
}

TEST(BentProgram, FollowsTheSurfaceOnArcs) {
    const auto targets = targets_of("G1 F600 X20 Y30 Z5\nG2 I10 J0\nG3 X40 R10", setup());
    std::vector<std::vector<double>> arc = targets;
    std::size_t first = 0;
    while (std::abs(targets[first][0] - 20) > 1e-9 || std::abs(targets[first][1] - 30) > 1e-9) { ++first; }
    arc.erase(arc.begin(), arc.begin() + static_cast<long>(first));
    EXPECT_LE(deviation(arc.front(), arc, 5), 2 * kTolerance_mm);
    for (const auto& place : arc) {
        if (place[0] <= 40) { EXPECT_GE(std::hypot(place[0] - 30, place[1] - 30), 9.9); }
    }
}

TEST(BentProgram, HasItsOwnPlacesOnALevelSurface) {
    // G91 and a word for one axis count from the program's places, not from the bent ones.
    const auto targets = targets_of("G91 G1 F600 X10\nX10\nX-20", setup());
    EXPECT_NEAR(targets.back()[0], 20, 1e-12);
    EXPECT_NEAR(targets.back()[2], 20, 1e-12);
    EXPECT_NEAR(targets_of("G1 F600 Z5 X10 Y0", setup()).back()[2], 5, 1e-12) << "the first point of the map";
}

TEST(BentProgram, WithALevelSurfaceIsTheSameProgram) {
    GcodeSetup level = setup(false);
    std::vector<HeightPoint> flat = points();
    for (HeightPoint& point : flat) { point.z_mm = 3; }
    level.switches.heights = std::make_shared<const HeightMap>(HeightMap::make(flat).value());
    const auto bent = targets_of("G1 F600 X50 Y60 Z3\nX10", level);
    EXPECT_EQ(bent.back(), targets_of("G1 F600 X50 Y60 Z3\nX10", setup(false)).back());
}

std::string program_error(const std::string& text) {
    const auto program = parse_gcode(text, setup());
    return program ? "" : program.error().front().message;
}

TEST(BentProgram, MayNotCutBesideTheMap) {
    EXPECT_THAT(program_error("G1 F600 X60"),
                HasSubstr("leaves the height map, which has X 10 to 50 and Y 0 to 60 mm"));
    EXPECT_THAT(program_error("G0 X0\nG1 F600 X20"), HasSubstr("leaves the height map"));
    EXPECT_THAT(program_error("G2 F600 I20 J0"), HasSubstr("leaves the height map"));
    EXPECT_THAT(parse_gcode("G2 F600 I20 J0", setup()).error(), testing::SizeIs(1)) << "once for all chords";
    EXPECT_EQ(program_error("G0 X0 Y80\nG1 F60 Z10\nG0 Z20"), "") << "rapid moves, and moves of Z alone, may";
}

TEST(BentProgram, MayNotProbe) {
    GcodeSetup probing = setup();
    probing.inputs = {{.name = "tip", .motor = "Z", .channel = 3, .use = InputUse::Probe, .number = 0}};
    const auto program = parse_gcode("G38.2 Z0 F60", probing);
    ASSERT_FALSE(program);
    EXPECT_THAT(program.error().front().message, HasSubstr("cannot probe"));
}

TEST(BentProgram, NeedsXYAndZ) {
    GcodeSetup plotter = setup();
    plotter.axes.pop_back();
    const auto program = parse_gcode("G1 F600 X30", plotter);
    ASSERT_FALSE(program);
    EXPECT_THAT(program.error().front().message, HasSubstr("the machine has no axis Z"));
}

}  // namespace
}  // namespace lockstep
