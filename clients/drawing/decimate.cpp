#include "clients/drawing/decimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lockstep::drawing {
namespace {

/// Indices of a column's four points in the curve.
struct Column {
    std::size_t first = 0;
    std::size_t lowest = 0;
    std::size_t highest = 0;
    std::size_t last = 0;
};

void keep(const Column& column, const std::vector<Point>& from, std::vector<Point>& to) {
    std::array<std::size_t, 4> places = {column.first, column.lowest, column.highest, column.last};
    std::ranges::sort(places);
    const auto end = std::unique(places.begin(), places.end());
    for (auto place = places.begin(); place != end; ++place) { to.push_back(from[*place]); }
}

/// Positive if b is to the left of a, by less than half a turn.
double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

/// The directions in which a line from `anchor` passes every later point within the tolerance. They lie between two
/// rays that are less than half a turn apart.
class Sleeve {
public:
    Sleeve(Point anchor, double tolerance) : anchor_(anchor), tolerance_(tolerance) {}

    /// Returns false if `point` is outside the sleeve, or if the path reversed: it is nearer to the anchor than the
    /// farthest point by more than the tolerance.
    bool takes(Point point) {
        const Point to{point.x - anchor_.x, point.y - anchor_.y};
        const double square = to.x * to.x + to.y * to.y;
        if (square < farthest_square_ && std::sqrt(square) + tolerance_ < std::sqrt(farthest_square_)) { return false; }
        farthest_square_ = std::max(farthest_square_, square);
        const double tangent_square = square - tolerance_ * tolerance_;
        return tangent_square <= 0 || narrow(to, std::sqrt(tangent_square));
    }

private:
    /// Narrows the sleeve to the tangents from the anchor to the tolerance circle around the point. `tangent`: their
    /// length.
    bool narrow(Point to, double tangent) {
        const Point right{to.x * tangent + to.y * tolerance_, to.y * tangent - to.x * tolerance_};
        const Point left{to.x * tangent - to.y * tolerance_, to.y * tangent + to.x * tolerance_};
        if (open_ && (cross(right_, to) < 0 || cross(to, left_) < 0)) { return false; }
        if (!open_ || cross(right_, right) > 0) { right_ = right; }
        if (!open_ || cross(left, left_) > 0) { left_ = left; }
        open_ = true;
        return true;
    }

    Point anchor_;
    double tolerance_;
    double farthest_square_ = 0;  // distance from the anchor
    bool open_ = false;
    Point right_;
    Point left_;
};

}  // namespace

std::vector<Point> decimate_columns(const std::vector<Point>& points) {
    std::vector<Point> kept;
    for (std::size_t i = 0; i < points.size();) {
        const double column = std::floor(points[i].x);
        Column of{i, i, i, i};
        for (; i < points.size() && std::floor(points[i].x) == column; ++i) {
            if (points[i].y < points[of.lowest].y) { of.lowest = i; }
            if (points[i].y > points[of.highest].y) { of.highest = i; }
            of.last = i;
        }
        keep(of, points, kept);
    }
    return kept;
}

std::vector<Point> decimate_path(const std::vector<Point>& points, double tolerance) {
    if (points.size() < 3) { return points; }
    std::vector<Point> kept = {points.front()};
    Sleeve sleeve(points.front(), tolerance);
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (sleeve.takes(points[i])) { continue; }
        kept.push_back(points[i - 1]);
        sleeve = Sleeve(points[i - 1], tolerance);
        (void)sleeve.takes(points[i]);
    }
    kept.push_back(points.back());
    return kept;
}

}  // namespace lockstep::drawing
