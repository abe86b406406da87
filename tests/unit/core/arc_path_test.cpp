// The geometry of arcs for estimates, travel checks and pictures.
#include "core/arc_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lockstep {
namespace {

using Places = std::vector<double>;

TEST(ArcPath, HasTheLengthOfItsAngle) {
    const Places from{10, 0, 0};
    const Places to{0, 10, 3};
    EXPECT_NEAR(ArcPath({}, from, to).length_mm(), std::hypot(5 * std::numbers::pi, 3), 1e-12);
    EXPECT_NEAR(ArcPath({.is_clockwise = true}, from, to).plane_length_mm(), 15 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(ArcPath({.turns = 2}, from, from).plane_length_mm(), 40 * std::numbers::pi, 1e-12);
}

TEST(ArcPath, ExtendsToTheDirectionsThatItCrosses) {
    const Places from{std::sqrt(50), -std::sqrt(50)};
    const Places to{std::sqrt(50), std::sqrt(50)};
    const auto near = ArcPath({}, from, to).extent(0);
    EXPECT_NEAR(near.first, std::sqrt(50), 1e-12);
    EXPECT_NEAR(near.second, 10, 1e-12);
    const auto far = ArcPath({.is_clockwise = true}, from, to).extent(0);
    EXPECT_NEAR(far.first, -10, 1e-12);
    EXPECT_NEAR(far.second, std::sqrt(50), 1e-12);
    const auto aside = ArcPath({.is_clockwise = true}, from, to).extent(1);
    EXPECT_NEAR(aside.first, -10, 1e-12);
    EXPECT_NEAR(aside.second, 10, 1e-12);
}

TEST(ArcPath, ChordsStayWithinTheirToleranceAndEndAtTheTarget) {
    const Places from{10, 0, 0};
    const Places to{-10, 1e-15, 2};
    Places before = from;
    int chords = 0;
    ArcPath({}, from, to).each_chord(0.01, [&](const Places& at) {
        const double middle = std::hypot((before[0] + at[0]) / 2, (before[1] + at[1]) / 2);
        EXPECT_GT(middle, 10 - 0.0101);
        before = at;
        ++chords;
    });
    EXPECT_EQ(before, to);
    EXPECT_NEAR(chords, 35, 2);
}

TEST(ArcPath, TellsWhyAnArcCannotBeRun) {
    const Places from{10, 0};
    const Places to{0, 11};
    EXPECT_NE(why_no_arc(ArcPath({}, from, to)).find("10 mm at the start and 11 mm at the end"), std::string::npos);
    EXPECT_NE(why_no_arc(ArcPath({}, Places{0, 0}, to)).find("radius of 0"), std::string::npos);
    EXPECT_EQ(why_no_arc(ArcPath({}, from, Places{0, 10.005})), "");
}

}  // namespace
}  // namespace lockstep
