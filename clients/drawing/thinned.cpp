#include "clients/drawing/thinned.hpp"

#include <algorithm>
#include <utility>

#include "clients/drawing/decimate.hpp"

namespace lockstep::drawing {
namespace {

double extent_of(const std::vector<Point>& points) {
    const auto [left, right] = std::ranges::minmax(points, {}, &Point::x);
    const auto [low, high] = std::ranges::minmax(points, {}, &Point::y);
    return std::max(right.x - left.x, high.y - low.y);
}

}  // namespace

/// Thinning keeps four points of each of kMostPoints / 8 columns, eight times as many columns as a picture has.
void ThinnedCurve::add(Point point) {
    points_.push_back(point);
    if (points_.size() < kMostPoints) { return; }
    constexpr double kColumns = kMostPoints / 8.0;
    const double width = (points_.back().x - points_.front().x) / kColumns;
    if (width <= 0) { return points_.resize(kMostPoints / 2); }
    for (Point& each : points_) { each.x /= width; }
    points_ = decimate_columns(points_);
    for (Point& each : points_) { each.x *= width; }
}

void ThinnedPath::add(Point point) {
    points_.push_back(point);
    if (points_.size() < most_points_) { return; }
    tolerance_ = std::max(tolerance_, extent_of(points_) / 20'000);
    if (tolerance_ <= 0) { return points_.resize(1); }
    std::vector<Point> left = decimate_path(points_, tolerance_);
    for (; left.size() > most_points_ / 2; tolerance_ *= 2) { left = decimate_path(points_, 2 * tolerance_); }
    points_ = std::move(left);
}

}  // namespace lockstep::drawing
