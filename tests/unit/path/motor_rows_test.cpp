#include "core/path/geometry/motor_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lockstep {
namespace {

constexpr double kPerMm = 80;
constexpr double kAxisPerMm = 1280;
constexpr std::array<DeltaMap::Tower, 3> kTowers{{{-130, -75, 320}, {130, -75, 320}, {0, 150, 310}}};

/// X, Y and Z by three carriages, and E by a motor of its own.
PathSetup delta_setup() {
    const DeltaMap map(kTowers);
    MachineDelta delta{.map = map,
                       .axes = {AxisIndex{0}, AxisIndex{1}, AxisIndex{2}},
                       .motors = {MotorIndex{0}, MotorIndex{1}, MotorIndex{2}}};
    delta.axis_steps_per_mm = {kAxisPerMm, kAxisPerMm, kAxisPerMm};
    delta.motor_steps_per_mm = {kPerMm, kPerMm, kPerMm};
    LinearMap shares = LinearMap::identity(4);
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 3; ++i) { shares.factor(k, i) = kPerMm / kAxisPerMm; }
    }
    PathSetup setup{.limits = std::vector<AxisLimits>(4), .steps_per_mm = {}, .frame_ticks = Ticks{1000}};
    setup.steps_per_mm = {kAxisPerMm, kAxisPerMm, kAxisPerMm, kPerMm};
    setup.use_map(MotorMap(shares, delta), std::vector<AxisLimits>(4));
    return setup;
}

PathSetup belts() {
    LinearMap map(2, 2);
    map.factor(0, 0) = map.factor(0, 1) = map.factor(1, 0) = 1.0 / 16;
    map.factor(1, 1) = -1.0 / 16;
    PathSetup setup{.limits = std::vector<AxisLimits>(2), .steps_per_mm = {}, .frame_ticks = Ticks{1000}};
    setup.steps_per_mm = {kAxisPerMm, kAxisPerMm};
    setup.use_map(map, std::vector<AxisLimits>(2));
    return setup;
}

/// From a place by a way, in mm, with a curvature of `bend` rad per mm in X and Y.
Quadratic piece(const std::vector<double>& from, const std::vector<double>& way, const PathSetup& setup,
                double bend = 0) {
    Quadratic axes;
    double square = 0;
    for (std::size_t i = 0; i < from.size(); ++i) { square += way[i] * way[i]; }
    axes.length = std::sqrt(square);
    axes.is_straight = bend == 0;
    axes.piece = 7;
    for (std::size_t i = 0; i < from.size(); ++i) {
        axes.from.append(from[i] * setup.steps_per_mm[i]);
        axes.slope.append(way[i] * setup.steps_per_mm[i] / axes.length);
        axes.bend.append(i < 2 ? bend * way[1 - i] / axes.length * (i == 0 ? -1 : 1) * setup.steps_per_mm[i] : 0);
    }
    return axes;
}

std::vector<Quadratic> rows_along(const PathSetup& setup, const Quadratic& axes) {
    std::vector<Quadratic> rows;
    for (RowPieces pieces(setup, axes); !pieces.is_done();) { rows.push_back(pieces.next()); }
    return rows;
}

long double carriage(std::size_t k, const Quadratic& axes, double u) {
    const long double p = axes.place(0, u) / kAxisPerMm - kTowers[k].x_mm;
    const long double q = axes.place(1, u) / kAxisPerMm - kTowers[k].y_mm;
    const long double rod = kTowers[k].rod_mm;
    return kPerMm * (axes.place(2, u) / kAxisPerMm + std::sqrt(rod * rod - p * p - q * q));
}

std::vector<Quadratic> examples() {
    const PathSetup setup = delta_setup();
    return {piece({-70, -60, 5, 0}, {140, 120, 30, 12}, setup), piece({10, 20, 0, 3}, {0.3, -0.1, 0.02, 0}, setup),
            piece({70, -70, 0, 0}, {-1, 139, 0, 0}, setup), piece({30, 0, 10, 0}, {4, 9, 0, 1}, setup, 0.03)};
}

TEST(RowPieces, OfALinearMapAreOne) {
    const PathSetup setup = belts();
    const std::vector<Quadratic> rows = rows_along(setup, piece({3, 4}, {50, -20}, setup));
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_TRUE(rows[0].is_straight);
    EXPECT_NEAR(rows[0].from[0], 7 * kPerMm, 1e-9);
    EXPECT_NEAR(rows[0].place(1, rows[0].length), (53 + 16) * kPerMm, 1e-9);
}

TEST(RowPieces, MeetWithTheSamePlacesAndSlopes) {
    for (const Quadratic& axes : examples()) {
        const std::vector<Quadratic> rows = rows_along(delta_setup(), axes);
        double u = 0;
        for (std::size_t n = 0; n < rows.size(); ++n) {
            EXPECT_NEAR(rows[n].begin, u, 1e-9);
            EXPECT_EQ(rows[n].piece, 7U);
            u += rows[n].length;
            if (n == 0) { continue; }
            const Quadratic& before = rows[n - 1];
            for (std::size_t i = 0; i < 8; ++i) {
                EXPECT_NEAR(before.place(i, before.length), rows[n].from[i], 1e-7) << "row " << i;
                EXPECT_NEAR(before.slope_at(i, before.length), rows[n].slope_at(i, 0), 1e-9) << "row " << i;
            }
        }
        EXPECT_NEAR(u, axes.length, 1e-9);
    }
}

TEST(RowPieces, FollowTheCarriagesWithinTheirShareOfAStep) {
    for (const Quadratic& axes : examples()) {
        double furthest = 0;
        for (const Quadratic& rows : rows_along(delta_setup(), axes)) {
            for (double share = 0; share <= 1; share += 1.0 / 64) {
                const double u = share * rows.length;
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto off = static_cast<double>(carriage(k, axes, rows.begin + u) - rows.place(k, u));
                    furthest = std::max(furthest, std::abs(off));
                }
                for (std::size_t i = 0; i < 4; ++i) {
                    ASSERT_NEAR(rows.place(4 + i, u), axes.place(i, rows.begin + u), 1e-7) << "axis " << i;
                }
                ASSERT_NEAR(rows.place(3, u), axes.place(3, rows.begin + u), 1e-7);
            }
        }
        EXPECT_LE(furthest, kMapShare);
    }
}

/// Carriages rest on whole steps, half a step at most beside the curve of their line. The whole move leads from there
/// and to there: no part of it is bent more than the others.
TEST(RowPieces, LeadToWholeStepsOverTheWholeMove) {
    constexpr double kHair_mm = 1e-4;
    for (Quadratic axes : examples()) {
        axes.begins_at_rest = axes.ends_at_rest = true;
        for (std::size_t i = 0; i < 4; ++i) { axes.from[i] = std::round(axes.from[i]); }
        const std::vector<Quadratic> rows = rows_along(delta_setup(), axes);
        for (std::size_t k = 0; k < 3; ++k) {
            const double begin = rows.front().from[k] - static_cast<double>(carriage(k, axes, 0));
            const Quadratic& last = rows.back();
            const double end = last.place(k, last.length) - static_cast<double>(carriage(k, axes, axes.length));
            EXPECT_EQ(rows.front().from[k], std::round(rows.front().from[k]));
            EXPECT_NEAR(last.place(k, last.length), std::round(last.place(k, last.length)), 1e-7);
            for (const Quadratic& part : rows) {
                const double middle = part.begin + part.length / 2;
                const double slope =
                    static_cast<double>(carriage(k, axes, middle + kHair_mm) - carriage(k, axes, middle - kHair_mm)) /
                    (2 * kHair_mm);
                const double bends = 4 * kMapShare / part.length;  // a quadratic within kMapShare of the curve
                EXPECT_NEAR(part.slope[k] - slope, (end - begin) / axes.length, bends) << "at " << part.begin << " mm";
                EXPECT_NEAR(part.from[k] - static_cast<double>(carriage(k, axes, part.begin)),
                            begin + (end - begin) * part.begin / axes.length, kMapShare);
            }
        }
    }
}

/// A part of a line is some mm long; the number of parts grows with the cube root of the steps.
TEST(RowPieces, AreFew) {
    EXPECT_LE(rows_along(delta_setup(), examples()[0]).size(), 64U);
    EXPECT_EQ(rows_along(delta_setup(), examples()[1]).size(), 2U);
}

/// Along the towers all motors are linear.
TEST(RowPieces, StraightUpAreOne) {
    const PathSetup setup = delta_setup();
    const std::vector<Quadratic> rows = rows_along(setup, piece({20, -30, 5, 0}, {0, 0, 60, 4}, setup));
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_TRUE(rows[0].is_straight);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(rows[0].place(k, rows[0].length) - rows[0].from[k], 60 * kPerMm, 1e-7);
    }
}

/// Half steps of motors are common where axes rest; the last bit of a place must not decide how they are rounded.
TEST(RowPieces, RestWhereTheNextMoveBegins) {
    for (const PathSetup& setup : {belts(), delta_setup()}) {
        for (int n = 1; n < 2'000; ++n) {
            Quadratic axes;
            std::vector<Position> end;
            axes.length = 0.1 + n / 7.0;
            axes.begins_at_rest = axes.ends_at_rest = true;
            for (std::size_t i = 0; i < setup.axes(); ++i) {
                end.push_back(Position::steps(i == 0 ? 5 * n + 8 : -n));
                axes.from.append(0);
                axes.slope.append(end.back().as_steps() / axes.length);
                axes.bend.append(0);
            }
            const Quadratic last = rows_along(setup, axes).back();
            const MotorPositions rest = motors_at_rest(setup, end);
            for (std::size_t m = 0; m < setup.motors(); ++m) {
                ASSERT_NEAR(last.place(m, last.length), rest[m].as_steps(), 1e-6) << "motor " << m << " of " << n;
            }
        }
    }
}

}  // namespace
}  // namespace lockstep
