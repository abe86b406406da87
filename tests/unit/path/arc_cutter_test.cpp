#include "core/path/geometry/arc_cutter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lockstep {
namespace {

constexpr double kPi = std::numbers::pi;

PathSetup mill_setup() {
    return {std::vector<AxisLimits>(3, {.min_steps = -100'000, .max_steps = 100'000}), {80, 80, 400}, Ticks{1000}};
}

/// The deviation of the pieces from a helix and their length, in mm.
struct Shape {
    double deviation = 0;
    double length = 0;
    PlaceVector end;
};

Shape shape_of(const std::vector<Quadratic>& pieces, double x, double y, double radius) {
    Shape shape;
    for (const Quadratic& piece : pieces) {
        for (const double share : {0.0, 0.2, 0.5, 0.8, 1.0}) {
            const double u = share * piece.length;
            const double r = std::hypot(piece.place(0, u) / 80 - x, piece.place(1, u) / 80 - y);
            shape.deviation = std::max(shape.deviation, std::abs(r - radius));
        }
        shape.length += piece.length;
        shape.end = piece.from;
        for (std::size_t i = 0; i < 3; ++i) { shape.end[i] = piece.place(i, piece.length); }
    }
    return shape;
}

std::vector<Quadratic> cut(const PathArc& arc, const std::vector<double>& from_mm) {
    PathTrail trail;
    const PlaceVector from = mill_setup().to_steps(from_mm);
    EXPECT_TRUE(cut_arc(mill_setup(), arc.shape, {from, from, mill_setup().to_steps(arc.to_mm)}, {}, 1, trail));
    std::vector<Quadratic> pieces;
    for (std::size_t k = 0; k < trail.end(); ++k) { pieces.push_back(trail.piece(k)); }
    return pieces;
}

TEST(ArcCutter, CutsAWholeCircleThatEndsWhereItBegins) {
    const Shape shape = shape_of(cut({{.centre_first_mm = 10}, {0, 0, 0}}, {0, 0, 0}), 10, 0, 10);
    EXPECT_LT(shape.deviation * 80, 0.11);
    EXPECT_NEAR(shape.length, 20 * kPi, 1e-3);
    EXPECT_NEAR(shape.end[0], 0, 1e-9);
}

TEST(ArcCutter, TurnsEitherWay) {
    const double to = 10 - 10 * std::cos(1.0);
    const double side = 10 * std::sin(1.0);
    const PathArc clockwise{{.centre_first_mm = 10, .is_clockwise = true}, {to, side, 0}};
    EXPECT_NEAR(shape_of(cut(clockwise, {0, 0, 0}), 10, 0, 10).length, 10, 1e-3);
    const PathArc counter{{.centre_first_mm = 10}, {to, side, 0}};
    EXPECT_NEAR(shape_of(cut(counter, {0, 0, 0}), 10, 0, 10).length, 10 * (2 * kPi - 1), 1e-3);
}

TEST(ArcCutter, CutsAHelixOfSeveralTurns) {
    const PathArc arc{{.centre_first_mm = 5, .turns = 3}, {0, 0, 6}};
    const std::vector<Quadratic> pieces = cut(arc, {0, 0, 0});
    const Shape shape = shape_of(pieces, 5, 0, 5);
    EXPECT_LT(shape.deviation * 80, 0.11);
    EXPECT_NEAR(shape.length, std::hypot(30 * kPi, 6), 1e-3);
    EXPECT_NEAR(shape.end[2], 2400, 1e-9);
    EXPECT_NEAR(pieces[pieces.size() / 2].from[2], 1200, 1e-6);
}

TEST(ArcCutter, PiecesFollowEachOtherWithoutGaps) {
    const std::vector<Quadratic> pieces = cut({{.centre_first_mm = 3, .centre_second_mm = 4}, {6, 8, 1}}, {0, 0, 0});
    for (std::size_t k = 1; k < pieces.size(); ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Quadratic& before = pieces[k - 1];
            EXPECT_NEAR(before.place(i, before.length), pieces[k].from[i], 1e-9);
            EXPECT_NEAR(before.slope_at(i, before.length), pieces[k].slope_at(i, 0), 0.01 * 80);
        }
    }
}

TEST(ArcCutter, SpiralsWhereTheRadiiDiffer) {
    const std::vector<Quadratic> pieces = cut({{.centre_first_mm = 10}, {8, 0, 0}}, {0, 0, 0});
    const Quadratic& last = pieces.back();
    EXPECT_NEAR(last.place(0, last.length), 8 * 80, 1e-9);
}

/// The greatest distance of the pieces from the spiral about (0, 0) from (begin, 0), in mm.
double deviation_from_spiral(const std::vector<Quadratic>& pieces, double begin, double end, double sweep) {
    double greatest = 0;
    for (const Quadratic& piece : pieces) {
        for (const double share : {0.0, 0.2, 0.5, 0.8, 1.0}) {
            const double x = piece.place(0, share * piece.length) / 80;
            const double y = piece.place(1, share * piece.length) / 80;
            double least = std::hypot(x - begin, y);
            for (int k = 0; k <= 20'000; ++k) {
                const double angle = sweep * k / 20'000;
                const double radius = begin + (end - begin) * k / 20'000;
                least = std::min(least, std::hypot(x - radius * std::cos(angle), y - radius * std::sin(angle)));
            }
            greatest = std::max(greatest, least);
        }
    }
    return greatest;
}

TEST(ArcCutter, FollowsEachSpiralThatAProgramMayHave) {
    struct Spiral {
        double begin;
        double end;
        double sweep;
    };
    for (const Spiral& spiral : {Spiral{25, 25.0282, 1}, Spiral{1000, 1001.27, 0.5}, Spiral{0.0013, 0.073, 1.5},
                                 Spiral{0.073, 0.0013, 3}, Spiral{1000, 1001, 0.001}, Spiral{0.02, 0.09, 6}}) {
        const std::vector<double> to{spiral.end * std::cos(spiral.sweep), spiral.end * std::sin(spiral.sweep), 0};
        const std::vector<Quadratic> pieces = cut({{}, to}, {spiral.begin, 0, 0});
        EXPECT_LT(80 * deviation_from_spiral(pieces, spiral.begin, spiral.end, spiral.sweep), 0.11) << spiral.begin;
        const Quadratic& last = pieces.back();
        EXPECT_NEAR(last.place(0, last.length), to[0] * 80, 1e-9);
        EXPECT_NEAR(last.place(1, last.length), to[1] * 80, 1e-9);
    }
}

TEST(ArcCutter, LeavesAnArcWithARadiusBelowTheStepsToALine) {
    PathTrail trail;
    const PlaceVector from = mill_setup().to_steps(std::vector<double>{0, 0, 0});
    const PlaceVector to = mill_setup().to_steps(std::vector<double>{0.005, 0, 0});
    EXPECT_FALSE(cut_arc(mill_setup(), {.centre_first_mm = 0.0025}, {from, from, to}, {}, 1, trail));
    EXPECT_EQ(trail.end(), 0U);
}

}  // namespace
}  // namespace lockstep
