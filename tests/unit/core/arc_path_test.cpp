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

/// A spiral about (0, 0) from (begin, 0).
struct Spiral {
    double begin;
    double end;
    double sweep;
    Places from{begin, 0};
    Places to{end * std::cos(sweep), end* std::sin(sweep)};
    ArcPath path() const { return {{}, from, to}; }
};

const std::vector<Spiral> kSpirals{
    {25, 25.0282, 2}, {0.0013, 0.073, 1.7}, {0.073, 0.0013, 3.2}, {7000, 7007, 0.001}, {0.02, 0.09, 6}};

TEST(ArcPath, OfASpiralExtendsToItsFarthestPlaces) {
    for (const Spiral& spiral : kSpirals) {
        const ArcPath path = spiral.path();
        for (const std::size_t axis : {0U, 1U}) {
            double least = spiral.from[axis];
            double greatest = least;
            for (int k = 0; k <= 100'000; ++k) {
                least = std::min(least, path.at(axis, k / 1e5));
                greatest = std::max(greatest, path.at(axis, k / 1e5));
            }
            EXPECT_NEAR(path.extent(axis).first, least, 1e-6 * spiral.end) << spiral.begin << " " << axis;
            EXPECT_NEAR(path.extent(axis).second, greatest, 1e-6 * spiral.end) << spiral.begin << " " << axis;
        }
    }
}

TEST(ArcPath, OfASpiralHasItsSlopeAndItsLength) {
    for (const Spiral& spiral : kSpirals) {
        const ArcPath path = spiral.path();
        double length = 0;
        for (int k = 0; k < 10'000; ++k) {
            const double share = k / 1e4;
            length +=
                std::hypot(path.at(0, share + 1e-4) - path.at(0, share), path.at(1, share + 1e-4) - path.at(1, share));
        }
        EXPECT_NEAR(path.plane_length_mm() / length, 1, 0.05) << spiral.begin;
        for (const std::size_t axis : {0U, 1U}) {
            const double slope = (path.at(axis, 0.5 + 1e-5) - path.at(axis, 0.5 - 1e-5)) / 2e-5;
            EXPECT_NEAR(path.slope(axis, 0.5), slope, 1e-4 * spiral.end) << spiral.begin;
        }
    }
}

TEST(ArcPath, ChordsOfASpiralStayWithinTheirTolerance) {
    for (const Spiral& spiral : kSpirals) {
        const ArcPath path = spiral.path();
        std::vector<Places> ends{spiral.from};
        path.each_chord(0.002, [&](const Places& at) { ends.push_back(at); });
        for (std::size_t i = 1; i < ends.size(); ++i) {
            const Places middle = path.at((static_cast<double>(i) - 0.5) / (static_cast<double>(ends.size()) - 1));
            const double x = ends[i][0] - ends[i - 1][0];
            const double y = ends[i][1] - ends[i - 1][1];
            const double off = (x * (middle[1] - ends[i - 1][1]) - y * (middle[0] - ends[i - 1][0])) / std::hypot(x, y);
            EXPECT_LE(std::abs(off), 0.00201) << spiral.begin;
        }
    }
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
