// The errors of a screw from Bezier curves. It shares no code with core/kinematics/screw.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace lockstep {

class ScrewByBezier {
public:
    struct Point {
        double place = 0;
        double error = 0;
    };

    /// No points: an exact screw.
    explicit ScrewByBezier(std::vector<Point> points = {}) : points_(std::move(points)) {}

    bool is_exact() const { return points_.empty(); }
    /// The error, and its slope.
    double error(double place) const { return at(place).first; }
    double slope(double place) const { return at(place).second; }

    double most_slope() const {
        double most = 0;
        for (std::size_t k = 0; k < points_.size(); ++k) {
            most = std::max(most, std::abs(tangent(k)));
            if (k + 1 < points_.size()) { most = std::max(most, std::abs(middle_slope(k))); }
        }
        return most;
    }
    double most_bend() const {
        double most = 0;
        for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
            const double half = (points_[k + 1].place - points_[k].place) / 2;
            most = std::max({most, std::abs(middle_slope(k) - tangent(k)) / half,
                             std::abs(tangent(k + 1) - middle_slope(k)) / half});
        }
        return most;
    }

private:
    using Curve = std::pair<double, double>;

    Curve at(double place) const {
        if (points_.empty()) { return {0, 0}; }
        const std::size_t last = points_.size() - 1;
        if (place <= points_[0].place) { return line(0, place); }
        if (place >= points_[last].place) { return line(last, place); }
        std::size_t k = 0;
        while (points_[k + 1].place < place) { ++k; }
        const double width = points_[k + 1].place - points_[k].place;
        const double left = points_[k].error + tangent(k) * width / 4;
        const double right = points_[k + 1].error - tangent(k + 1) * width / 4;
        const double middle = (left + right) / 2;
        const double s = (place - points_[k].place) / width * 2;
        return s < 1 ? bezier(points_[k].error, left, middle, s, width / 2)
                     : bezier(middle, right, points_[k + 1].error, s - 1, width / 2);
    }
    Curve line(std::size_t k, double place) const {
        return {points_[k].error + tangent(k) * (place - points_[k].place), tangent(k)};
    }
    static Curve bezier(double a, double b, double c, double s, double width) {
        return {(1 - s) * ((1 - s) * a + s * b) + s * ((1 - s) * b + s * c),
                2 * ((1 - s) * (b - a) + s * (c - b)) / width};
    }
    double chord(std::size_t k) const {
        return (points_[k + 1].error - points_[k].error) / (points_[k + 1].place - points_[k].place);
    }
    double middle_slope(std::size_t k) const { return 2 * chord(k) - (tangent(k) + tangent(k + 1)) / 2; }
    /// Of the parabola through a point and its neighbours.
    double tangent(std::size_t k) const {
        if (k == 0) { return chord(0); }
        if (k + 1 == points_.size()) { return chord(k - 1); }
        const double share = (points_[k].place - points_[k - 1].place) / (points_[k + 1].place - points_[k - 1].place);
        return chord(k - 1) + share * (chord(k) - chord(k - 1));
    }

    std::vector<Point> points_;
};

}  // namespace lockstep
