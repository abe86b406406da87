#include "core/kinematics/delta_map.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kLeastRoot = 1e-3;  // of the rod: out of reach the root is no less

double root_of(double rod_mm, double square_mm2) {
    const double least = kLeastRoot * rod_mm;
    return std::sqrt(std::max(rod_mm * rod_mm - square_mm2, least * least));
}

}  // namespace

double DeltaMap::root_mm(std::size_t tower, const Point& at) const {
    const double p = at.x - towers_[tower].x_mm;
    const double q = at.y - towers_[tower].y_mm;
    return root_of(towers_[tower].rod_mm, p * p + q * q);
}

/// The tool is where three spheres about the joints of the carriages meet. From the first joint, with d the way to
/// another one, 2 P d = |d|^2 + rod0^2 - rod^2: two planes, which give x and y by z. The first sphere gives z.
DeltaMap::Point DeltaMap::place(const std::array<double, kTowers>& heights_mm) const {
    struct Plane {
        double x, y, z, right;
    };
    const Tower& first = towers_[0];
    const auto plane = [&](std::size_t k) {
        const Tower& tower = towers_[k];
        const double x = tower.x_mm - first.x_mm;
        const double y = tower.y_mm - first.y_mm;
        const double z = heights_mm[k] - heights_mm[0];
        const double rods = first.rod_mm * first.rod_mm - tower.rod_mm * tower.rod_mm;
        return Plane{x, y, z, (x * x + y * y + z * z + rods) / 2};
    };
    const Plane a = plane(1);
    const Plane b = plane(2);
    const double area = a.x * b.y - b.x * a.y;
    const double x0 = (a.right * b.y - b.right * a.y) / area;
    const double y0 = (a.x * b.right - b.x * a.right) / area;
    const double x_z = (b.z * a.y - a.z * b.y) / area;
    const double y_z = (b.x * a.z - a.x * b.z) / area;
    const double square = 1 + x_z * x_z + y_z * y_z;
    const double half = x0 * x_z + y0 * y_z;
    const double rest = x0 * x0 + y0 * y0 - first.rod_mm * first.rod_mm;
    const double z = (-half - std::sqrt(std::max(half * half - square * rest, 0.0))) / square;
    return {first.x_mm + x0 + x_z * z, first.y_mm + y0 + y_z * z, heights_mm[0] + z};
}

/// Slopes grow with both distances from the tower, and so do heights fall.
DeltaMap::Reach DeltaMap::reach(std::size_t tower, const Point& low, const Point& high) const {
    const auto& [x, y, rod] = towers_[tower];
    const double p = std::max(std::abs(low.x - x), std::abs(high.x - x));
    const double q = std::max(std::abs(low.y - y), std::abs(high.y - y));
    const double near_p = std::max({low.x - x, x - high.x, 0.0});
    const double near_q = std::max({low.y - y, y - high.y, 0.0});
    const double root = root_of(rod, p * p + q * q);
    return {.furthest_mm = std::sqrt(p * p + q * q),
            .lowest_mm = low.z + root,
            .highest_mm = high.z + root_of(rod, near_p * near_p + near_q * near_q),
            .steepest = {std::min(p, rod) / root, std::min(q, rod) / root, 1},
            .least_root_mm = root};
}

}  // namespace lockstep
