// The commanded steps of a move are those along its curve, and its distance is measured from its curve.
#include "clients/analysis/asked/asked_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "services/record/reading/recorded_program.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

constexpr double kRadius_mm = 10;
constexpr std::int64_t kRadius_steps = 1000;

/// A full circle from its rightmost point, counter-clockwise.
Program circle() {
    Program program{.name = "circle", .axes = {"X", "Y"}, .start_mm = {50, 40}, .blocks = {}};
    ProgramMove move{{50, 40}, 50, false};
    move.arc = ArcShape{.first = 0, .second = 1, .centre_first_mm = 40, .centre_second_mm = 40};
    program.blocks.push_back({1, move});
    return program;
}

AskedPath asked(const Program& program) {
    const auto recorded = std::make_shared<const RecordedProgram>(program);
    return AskedPath::of(test::two_axes(), recorded->head(), recorded).value();
}

TEST(AskedPathTest, CountsTheStepsAlongACircle) {
    const AskedPath path = asked(circle());
    ASSERT_EQ(path.size(), 1U);
    EXPECT_EQ(path.steps(0, MotorIndex{0}), 4 * kRadius_steps);
    EXPECT_EQ(path.steps(0, MotorIndex{1}), 4 * kRadius_steps);
}

TEST(AskedPathTest, ListsAWayForEachReversal) {
    const AskedPath path = asked(circle());
    const auto& x = path.strokes_of(MotorIndex{0});
    ASSERT_EQ(x.size(), 2U) << "left and back";
    EXPECT_EQ(x[0].from, 5000);
    EXPECT_EQ(x[0].to, 3000);
    EXPECT_EQ(x[1].to, 5000);
    EXPECT_EQ(path.strokes_of(MotorIndex{1}).size(), 3U) << "up, down and back";
}

TEST(AskedPathTest, KnowsLinesFromRestToRestExactly) {
    const AskedPath line = asked(test::path_through({{0, 0}, {1, 1}}));
    EXPECT_EQ(line.steps(0, MotorIndex{0}), 100);
    EXPECT_EQ(line.slack(0, MotorIndex{0}), 0);
    EXPECT_GT(asked(circle()).slack(0, MotorIndex{0}), 0);
}

TEST(AskedShapeTest, MeasuresTheDistanceFromTheCircle) {
    AskedShape shape = asked(circle()).shape(0);
    for (int degree = 0; degree < 360; ++degree) {
        const double angle = degree * std::acos(-1.0) / 180;
        const double off = degree % 3 == 0 ? 0.02 : 0;
        const std::vector<double> place{40 + (kRadius_mm + off) * std::cos(angle),
                                        40 + (kRadius_mm + off) * std::sin(angle)};
        EXPECT_NEAR(std::sqrt(shape.square_of_distance(place)), off, 1e-5) << degree;
    }
}

TEST(AskedShapeTest, MeasuresTheDistanceFromASpiral) {
    for (const auto& [begin, end, sweep] : {std::tuple{7000.0, 7007.0, 0.001}, std::tuple{25.0, 25.028, 3.0}}) {
        const std::vector<double> from{begin, 0};
        const std::vector<double> to{end * std::cos(sweep), end * std::sin(sweep)};
        const ArcPath path({}, from, to);
        AskedShape shape(from, to, ArcShape{});
        for (int k = 100; k < 900; ++k) {
            const auto [x, y] = path.direction(k / 1e3);
            const double off = k % 3 == 0 ? 0.02 : 0;
            const std::vector<double> place{path.at(0, k / 1e3) - off * y, path.at(1, k / 1e3) + off * x};
            EXPECT_NEAR(std::sqrt(shape.square_of_distance(place)), off, 1e-4) << begin << " " << k;
        }
    }
}

TEST(AskedShapeTest, MeasuresTheDistanceBeyondTheEndOfALineFromItsEnd) {
    AskedShape shape({0, 0}, {3, 4}, std::nullopt);
    EXPECT_DOUBLE_EQ(shape.square_of_distance(std::vector<double>{6, 8}), 25);
    EXPECT_DOUBLE_EQ(shape.square_of_distance(std::vector<double>{-3, -4}), 25);
    EXPECT_NEAR(shape.square_of_distance(std::vector<double>{1.5 + 0.8, 2 - 0.6}), 1, 1e-12);
}

}  // namespace
}  // namespace lockstep::analysis
