// Curves and paths of millions of points: few are kept, and the picture is the same.
#include "clients/drawing/thinned.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lockstep::drawing {
namespace {

constexpr int kPoints = 2'000'000;

TEST(ThinnedCurve, KeepsPeaksAndItsEnds) {
    ThinnedCurve curve;
    for (int i = 0; i <= kPoints; ++i) {
        const bool is_peak = i == 3 || i == 777'777;
        curve.add({i * 1e-3, is_peak ? 5 : std::sin(i * 1e-4)});
    }
    const auto& points = curve.points();
    EXPECT_LT(points.size(), ThinnedCurve::kMostPoints);
    EXPECT_TRUE(std::ranges::is_sorted(points, {}, &Point::x));
    EXPECT_EQ(std::ranges::count(points, 5.0, &Point::y), 2);
    EXPECT_NEAR(points.front().x, 0, 1e-9);
    EXPECT_NEAR(points.back().x, kPoints * 1e-3, 1e-6);
    for (const Point& point : points) {
        if (point.y < 5) { EXPECT_NEAR(point.y, std::sin(point.x * 0.1), 1e-6); }
    }
}

TEST(ThinnedCurve, StaysBoundedWhereXStandsStill) {
    ThinnedCurve curve;
    for (int i = 0; i <= kPoints; ++i) { curve.add({1, static_cast<double>(i)}); }
    EXPECT_LE(curve.points().size(), ThinnedCurve::kMostPoints);
}

TEST(ThinnedPath, StaysNearTheWay) {
    ThinnedPath path;
    for (int i = 0; i <= kPoints; ++i) {  // a spiral of 40 turns
        const double turn = 40.0 * i / kPoints;
        const double angle = 2 * std::numbers::pi * turn;
        path.add({turn * std::cos(angle), turn * std::sin(angle)});
    }
    const auto& points = path.points();
    EXPECT_LT(points.size(), ThinnedPath::kMostPoints);
    double longest = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
        const Point middle{(points[k - 1].x + points[k].x) / 2, (points[k - 1].y + points[k].y) / 2};
        const double radius = std::hypot(middle.x, middle.y);
        if (radius < 1) { continue; }  // the angle changes too fast there
        const double angle = std::atan2(middle.y, middle.x) / (2 * std::numbers::pi);
        const double off = radius - angle - std::round(radius - angle);  // from the nearest turn
        longest = std::max(longest, std::abs(off));
    }
    EXPECT_LT(longest, 0.02) << "of an extent of 80";
}

TEST(ThinnedPath, StaysBoundedOnASinglePlace) {
    ThinnedPath path;
    for (int i = 0; i <= kPoints; ++i) { path.add({7, 7}); }
    EXPECT_LE(path.points().size(), ThinnedPath::kMostPoints);
}

}  // namespace
}  // namespace lockstep::drawing
