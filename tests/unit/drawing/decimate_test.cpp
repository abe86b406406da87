#include "clients/drawing/decimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace lockstep::drawing {
namespace {

double distance(Point p, Point a, Point b) {
    const double length2 = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
    const double along = length2 == 0 ? 0 : ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length2;
    const double t = std::clamp(along, 0.0, 1.0);
    return std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y));
}

double farthest_from(const std::vector<Point>& line, const std::vector<Point>& points) {
    double worst = 0;
    for (const Point& p : points) {
        double nearest = 1e9;
        for (std::size_t i = 1; i < line.size(); ++i) {
            nearest = std::min(nearest, distance(p, line[i - 1], line[i]));
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

TEST(DecimateColumns, KeepsEveryPeakOfALongCurve) {
    std::vector<Point> curve;
    for (int i = 0; i < 1'000'000; ++i) { curve.push_back({i * 1e-3, i == 432'198 ? 900.0 : i % 7 * 1.0}); }
    const std::vector<Point> kept = decimate_columns(curve);
    EXPECT_LE(kept.size(), 4000U);
    EXPECT_EQ(std::ranges::count(kept, Point{432'198 * 1e-3, 900.0}), 1);
    EXPECT_EQ(kept.front(), curve.front());
    EXPECT_EQ(kept.back(), curve.back());
    EXPECT_TRUE(std::ranges::is_sorted(kept, {}, &Point::x));
}

TEST(DecimatePath, StaysWithinTheToleranceOnACircle) {
    std::vector<Point> circle;
    for (int i = 0; i <= 5000; ++i) {
        const double angle = i * 2 * std::numbers::pi / 5000;
        circle.push_back({300 * std::cos(angle), 300 * std::sin(angle)});
    }
    const std::vector<Point> kept = decimate_path(circle, 0.2);
    EXPECT_LT(kept.size(), 150U);
    EXPECT_LE(farthest_from(kept, circle), 0.2 + 1e-9);
}

TEST(DecimatePath, KeepsTheTipOfAReversal) {
    const std::vector<Point> there_and_back = {{0, 0}, {5, 0}, {10, 0}, {5, 0}, {0, 0}, {-3, 0}};
    EXPECT_EQ(decimate_path(there_and_back, 0.2), (std::vector<Point>{{0, 0}, {10, 0}, {-3, 0}}));
}

TEST(DecimatePath, StaysNearARandomWalk) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> step(-1, 1);
    std::vector<Point> walk = {{0, 0}};
    for (int i = 0; i < 2000; ++i) { walk.push_back({walk.back().x + step(random), walk.back().y + step(random)}); }
    EXPECT_LE(farthest_from(decimate_path(walk, 0.2), walk), 0.4);
}

}  // namespace
}  // namespace lockstep::drawing
