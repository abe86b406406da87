// The path of a program for a drawing.
#include "clients/web/program/path_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockstep::web {
namespace {

std::vector<PathPoint> circle(std::size_t points) {
    std::vector<PathPoint> path;
    for (std::size_t i = 0; i < points; ++i) {
        const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(points);
        path.push_back({.x = static_cast<float>(50 * std::cos(angle)), .y = static_cast<float>(50 * std::sin(angle))});
    }
    return path;
}

TEST(PathPoints, AreTheStartAndTheEndOfEachMoveThatGoesElsewhere) {
    const Program program{.axes = {"Y", "X"},
                          .start_mm = {1, 2},
                          .blocks = {{.line = 3, .action = ProgramMove{.target_mm = {1, 5}, .rapid = true}},
                                     {.line = 4, .action = ProgramMove{.target_mm = {1, 5}}},
                                     {.line = 5, .action = Dwell{}},
                                     {.line = 6, .action = ProgramMove{.target_mm = {8, 5}}}}};
    const std::vector<PathPoint> expected{{2, 1, 0, 0, true}, {5, 1, 0, 3, true}, {5, 8, 0, 6, false}};
    EXPECT_EQ(path_points(program), expected);
}

TEST(PathPoints, AReducedPathKeepsItsEndsAndItsTolerance) {
    const auto whole = circle(10'000);
    const ReducedPath reduced = reduced_path(whole, 100);
    EXPECT_LE(reduced.points.size(), 100u);
    EXPECT_EQ(reduced.points.front(), whole.front());
    EXPECT_EQ(reduced.points.back(), whole.back());
    EXPECT_LT(reduced.tolerance_mm, 1);
    for (const PathPoint& point : reduced.points) { EXPECT_NEAR(std::hypot(point.x, point.y), 50, 1e-3); }
}

TEST(PathPoints, AShortPathStaysAsItIs) {
    const auto whole = circle(10);
    EXPECT_EQ(reduced_path(whole, 10).points, whole);
    EXPECT_EQ(reduced_path(whole, 10).tolerance_mm, 0);
    EXPECT_EQ(reduced_path(whole, 2).points.size(), 2u);
}

TEST(PathPoints, AreSixteenBytesEach) {
    const std::string bytes = path_bytes({{1, 0, -2, 0x01020304, true}});
    EXPECT_EQ(bytes, std::string("\0\0\x80\x3f\0\0\0\0\0\0\0\xc0\x04\x03\x02\x81", 16));
}

}  // namespace
}  // namespace lockstep::web
