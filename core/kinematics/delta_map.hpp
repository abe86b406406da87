// A delta: three carriages move up and down on towers, and each carries the tool by a rod of fixed length.
//
// With (p, q) the tool's place in the plane minus the tower's, the carriage's height is
//
//     h = z + r,    r = sqrt(rod^2 - p^2 - q^2),    dh = dz - (p dx + q dy) / r.
//
// This and the way back need only sums, products, quotients and roots, so all processors compute the same bits.
#pragma once

#include <array>
#include <cstddef>

namespace lockstep {

class DeltaMap {
public:
    static constexpr std::size_t kTowers = 3;

    /// A place of the tool, or a change of it, in mm.
    struct Point {
        double x = 0;
        double y = 0;
        double z = 0;
    };
    struct Tower {
        double x_mm = 0;
        double y_mm = 0;
        double rod_mm = 0;
    };
    /// The range that a carriage needs for a travel.
    struct Reach {
        double furthest_mm = 0;  // from the tower, in the plane
        double lowest_mm = 0;    // heights
        double highest_mm = 0;
        Point steepest;            // the greatest |dh/dx|, |dh/dy| and |dh/dz|
        double least_root_mm = 0;  // r
    };

    /// The towers must not stand in a line.
    explicit DeltaMap(const std::array<Tower, kTowers>& towers) : towers_(towers) {}

    /// The height of a carriage, mm. Out of the rod's reach it is that of some place within.
    double height_mm(std::size_t tower, const Point& at) const { return at.z + root_mm(tower, at); }
    /// How much a carriage rises for a change of the tool's place.
    double rise_mm(std::size_t tower, const Point& at, const Point& change) const {
        const double across = (at.x - towers_[tower].x_mm) * change.x + (at.y - towers_[tower].y_mm) * change.y;
        return change.z - across / root_mm(tower, at);
    }
    /// The place of the tool below the carriages. If the rods cannot meet it is finite, and its heights are others.
    Point place(const std::array<double, kTowers>& heights_mm) const;
    /// Of the box with these corners.
    Reach reach(std::size_t tower, const Point& low, const Point& high) const;

private:
    double root_mm(std::size_t tower, const Point& at) const;

    std::array<Tower, kTowers> towers_;
};

}  // namespace lockstep
