#include "tests/simulation/simtest/record/carriages.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::simtest {

Carriages::Carriages(const MachineConfig& machine) {
    if (!machine.kinematics.delta) { return; }
    const DeltaConfig& delta = *machine.kinematics.delta;
    towers_ = delta.towers;
    const std::array<std::string, 3> names{delta.x, delta.y, delta.z};
    for (std::size_t k = 0; k < names.size(); ++k) {
        const auto axis = std::ranges::find(machine.axes, names[k], &AxisConfig::name);
        axes_[k] = static_cast<std::size_t>(axis - machine.axes.begin());
        low_[k] = axis->position_min_mm;
        high_[k] = axis->position_max_mm;
    }
}

std::optional<std::size_t> Carriages::tower_of(const std::string& motor) const {
    const auto tower = std::ranges::find(towers_, motor, &DeltaTower::motor);
    if (tower == towers_.end()) { return std::nullopt; }
    return static_cast<std::size_t>(tower - towers_.begin());
}

std::optional<std::size_t> Carriages::coordinate_of(std::size_t axis) const {
    const auto found = std::ranges::find(axes_, axis);
    if (none() || found == axes_.end()) { return std::nullopt; }
    return static_cast<std::size_t>(found - axes_.begin());
}

Carriages::Tool Carriages::tool(const std::vector<double>& axes_mm) const {
    return {axes_mm[axes_[0]], axes_mm[axes_[1]], axes_mm[axes_[2]]};
}

/// Motors that came to rest one by one may leave the tool where no rod reaches.
long double Carriages::rise(std::size_t tower, const Tool& at) const {
    const long double p = at[0] - towers_[tower].x_mm;
    const long double q = at[1] - towers_[tower].y_mm;
    const long double rod = towers_[tower].rod_mm;
    return std::sqrt(std::max(rod * rod - p * p - q * q, 1e-6L * rod * rod));
}

long double Carriages::change(std::size_t tower, const Tool& at, const Tool& by) const {
    const long double across = (at[0] - towers_[tower].x_mm) * by[0] + (at[1] - towers_[tower].y_mm) * by[1];
    return by[2] - across / rise(tower, at);
}

long double Carriages::bend(std::size_t tower, const Tool& at, const Tool& by) const {
    const long double across = (at[0] - towers_[tower].x_mm) * by[0] + (at[1] - towers_[tower].y_mm) * by[1];
    const long double rod = rise(tower, at);
    return -(by[0] * by[0] + by[1] * by[1]) / rod - across * across / (rod * rod * rod);
}

Carriages::Tool Carriages::furthest_corner(std::size_t tower) const {
    const DeltaTower& it = towers_[tower];
    const auto further = [](long double low, long double high, double from) {
        return std::abs(low - from) > std::abs(high - from) ? low : high;
    };
    return {further(low_[0], high_[0], it.x_mm), further(low_[1], high_[1], it.y_mm), low_[2]};
}

std::vector<Carriages::Tool> Carriages::samples() const {
    std::vector<Tool> all{{(low_[0] + high_[0]) / 2, (low_[1] + high_[1]) / 2, low_[2]}};
    for (const long double x : {low_[0], high_[0]}) {
        for (const long double y : {low_[1], high_[1]}) { all.push_back({x, y, low_[2]}); }
    }
    return all;
}

}  // namespace lockstep::simtest
