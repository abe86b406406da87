#include "sim_fpga/contacts/workpiece.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lockstep {
namespace {

/// The distance from a corner that `a` and `b`, distances from its two faces, enclose; negative within.
double corner_distance(double a, double b) {
    return std::hypot(std::max(a, 0.0), std::max(b, 0.0)) + std::min(std::max(a, b), 0.0);
}

double phase(double mm, const WorkBlock& block) { return 2 * std::numbers::pi * mm / block.wave_length_mm; }

/// The length of the normal (slope in X, slope in Y, 1) of a block's top.
double normal_length(const WorkBlock& block, double x_mm, double y_mm) {
    double rise_x = block.rise_x;
    double rise_y = block.rise_y;
    if (block.wave_mm != 0) {
        const double steepest = block.wave_mm * 2 * std::numbers::pi / block.wave_length_mm;
        const double x = phase(x_mm - block.x_min_mm, block);
        const double y = phase(y_mm - block.y_min_mm, block);
        rise_x += steepest * std::cos(x) * std::sin(y);
        rise_y += steepest * std::sin(x) * std::cos(y);
    }
    return std::hypot(rise_x, rise_y, 1.0);
}

double side_distance(const WorkBlock& block, const WorkPlace& at) {
    const double x = std::max(block.x_min_mm - at.x_mm, at.x_mm - block.x_max_mm);
    const double y = std::max(block.y_min_mm - at.y_mm, at.y_mm - block.y_max_mm);
    double distance = corner_distance(x, y);
    for (const WorkBore& bore : block.bores) {
        const double from_centre = std::hypot(at.x_mm - bore.x_mm, at.y_mm - bore.y_mm);
        distance = std::max(distance, bore.diameter_mm / 2 - from_centre);
    }
    return distance;
}

/// The place as the block sees it.
WorkPlace turned_back(const WorkBlock& block, const WorkPlace& at) {
    const double angle = -block.angle_deg * std::numbers::pi / 180;
    const double x = at.x_mm - block.x_min_mm;
    const double y = at.y_mm - block.y_min_mm;
    return {.x_mm = block.x_min_mm + x * std::cos(angle) - y * std::sin(angle),
            .y_mm = block.y_min_mm + x * std::sin(angle) + y * std::cos(angle),
            .z_mm = at.z_mm};
}

double distance_mm(const WorkBlock& block, const WorkPlace& place) {
    const WorkPlace at = block.angle_deg == 0 ? place : turned_back(block, place);
    const double x = std::clamp(at.x_mm, block.x_min_mm, block.x_max_mm);
    const double y = std::clamp(at.y_mm, block.y_min_mm, block.y_max_mm);
    const double height = (at.z_mm - Workpiece::top_mm(block, x, y)) / normal_length(block, x, y);
    return corner_distance(height, side_distance(block, at));
}

double distance_mm(const WorkPost& post, const WorkPlace& at) {
    const double from_centre = std::hypot(at.x_mm - post.x_mm, at.y_mm - post.y_mm);
    return corner_distance(at.z_mm - post.top_mm, from_centre - post.diameter_mm / 2);
}

}  // namespace

double Workpiece::top_mm(const WorkBlock& block, double x_mm, double y_mm) {
    const double x = x_mm - block.x_min_mm;
    const double y = y_mm - block.y_min_mm;
    const double plane = block.top_mm + block.rise_x * x + block.rise_y * y;
    if (block.wave_mm == 0) { return plane; }
    return plane + block.wave_mm * std::sin(phase(x, block)) * std::sin(phase(y, block));
}

double Workpiece::gap_mm(int probe, const WorkPlace& axes) const {
    const double radius = config_.tip_mm / 2;
    const WorkPlace ball{axes.x_mm, axes.y_mm, axes.z_mm - config_.tip_length_mm + radius};
    double gap = std::numeric_limits<double>::infinity();
    const auto add = [&](const auto& solid) {
        if (solid.probe == probe) { gap = std::min(gap, distance_mm(solid, ball) - radius); }
    };
    std::ranges::for_each(config_.blocks, add);
    std::ranges::for_each(config_.posts, add);
    return gap;
}

}  // namespace lockstep
