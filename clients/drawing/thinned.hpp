// Collects the points of a drawing one by one in bounded memory. Many points are thinned out, but remain finer than a
// picture shows.
#pragma once

#include <cstddef>
#include <vector>

#include "clients/drawing/svg.hpp"

namespace lockstep::drawing {

/// A value over an x that never falls. Peaks are kept.
class ThinnedCurve {
public:
    static constexpr std::size_t kMostPoints = 60'000;

    void add(Point point);
    const std::vector<Point>& points() const { return points_; }

private:
    std::vector<Point> points_;
};

/// A path in a plane, kept within 1/20,000 of its extent as long as its shape allows that.
class ThinnedPath {
public:
    static constexpr std::size_t kMostPoints = 200'000;

    explicit ThinnedPath(std::size_t most_points = kMostPoints) : most_points_(most_points) {}
    void add(Point point);
    const std::vector<Point>& points() const { return points_; }

private:
    std::size_t most_points_;
    std::vector<Point> points_;
    double tolerance_ = 0;
};

}  // namespace lockstep::drawing
