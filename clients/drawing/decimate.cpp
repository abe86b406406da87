#include "clients/drawing/decimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lockstep::drawing {
namespace {

/// Places of a column's four points in the curve.
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

/// The directions in which a line from `anchor` may leave and still pass every point since within the tolerance.
class Sleeve {
public:
    Sleeve(Point anchor, double tolerance) : anchor_(anchor), tolerance_(tolerance) {}

    /// False where `point` is out of the sleeve, or nearer to the anchor than the path has been: it turned back.
    bool takes(Point point) {
        const double dx = point.x - anchor_.x;
        const double dy = point.y - anchor_.y;
        const double distance = std::hypot(dx, dy);
        if (distance + tolerance_ < farthest_) { return false; }
        farthest_ = std::max(farthest_, distance);
        if (distance <= tolerance_) { return true; }
        return narrow(std::atan2(dy, dx), std::asin(tolerance_ / distance));
    }

private:
    bool narrow(double heading, double half_angle) {
        if (!open_) {
            open_ = true;
            middle_ = heading;
            low_ = -half_angle;
            high_ = half_angle;
            return true;
        }
        const double turn = std::remainder(heading - middle_, 2 * std::numbers::pi);
        if (turn < low_ || turn > high_) { return false; }
        low_ = std::max(low_, turn - half_angle);
        high_ = std::min(high_, turn + half_angle);
        return true;
    }

    Point anchor_;
    double tolerance_;
    double farthest_ = 0;
    bool open_ = false;
    double middle_ = 0;  // the angles below are relative to this heading
    double low_ = 0;
    double high_ = 0;
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
