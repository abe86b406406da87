#include "core/coordinator/path/braking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/path/path_setup.hpp"

namespace lockstep {

/// Places are in mm, of all axes of the machine.
struct Braking::Way {
    explicit Way(const MachineConfig& machine) : direction(machine.axes.size(), 0) {
        for (const AxisConfig& axis : machine.axes) {
            low.push_back(axis.position_min_mm);
            high.push_back(axis.position_max_mm);
        }
    }

    std::vector<double> direction;  // of length 1
    std::vector<double> low;        // the way lies between these places
    std::vector<double> high;
};

namespace {

/// Bounds on the slope of a motor along a way, and on how this changes: steps per mm, and per mm^2.
struct Slopes {
    double most = 0;
    double bend = 0;
};

/// With r the root in the height of a carriage (core/kinematics/delta_map.hpp), |r''| = (r^2 + (r r')^2) / r^3 in the
/// plane, which is at most rod^2 / r^3.
Slopes slopes_of_carriage(const MachineDelta& delta, std::size_t tower, std::span<const double> direction,
                          std::span<const double> low, std::span<const double> high) {
    const auto at = [&](std::span<const double> places) {
        return DeltaMap::Point{places[delta.axes[0]], places[delta.axes[1]], places[delta.axes[2]]};
    };
    const DeltaMap::Reach reach = delta.map.reach(tower, at(low), at(high));
    const DeltaMap::Point along = at(direction);
    const double across = std::hypot(along.x, along.y);
    const double root = reach.least_root_mm;
    const double rod = std::hypot(root, reach.furthest_mm);
    const double most = std::abs(along.x) * reach.steepest.x + std::abs(along.y) * reach.steepest.y +
                        std::abs(along.z) * reach.steepest.z;
    const double per_mm = delta.motor_steps_per_mm[tower];
    return {most * per_mm, rod * rod / (root * root * root) * across * across * per_mm};
}

double slope_of_sum(const LinearMap& shares, MotorIndex motor, std::span<const double> direction,
                    std::span<const double> steps_per_mm) {
    double slope = 0;
    for (std::size_t i = 0; i < direction.size(); ++i) {
        slope += shares.factor(motor, AxisIndex{i}) * direction[i] * steps_per_mm[i];
    }
    return std::abs(slope);
}

}  // namespace

Braking::Braking(const MachineConfig& machine, const Way& way) {
    const PathSetup setup = path_setup_of(machine);
    const MotorMap& map = setup.motor_map;
    const bool is_curved = setup.has_map() && map.bends(way.direction);
    const double per_second = machine.ticks_per_second();
    const auto add = [&](const AxisLimits& limits, const Slopes& slopes) {
        if (slopes.most <= 0) { return; }
        const double steps_per_tick2 = is_curved ? weaker(limits) : limits.max_deceleration;
        rows_.push_back({steps_per_tick2 * per_second * per_second / slopes.most, slopes.bend / slopes.most});
    };
    for (const AxisIndex i : axis_indices(setup.axes())) {
        add(setup.limits_of_axis(i), {std::abs(way.direction[i]) * setup.steps_per_mm[i], 0});
    }
    for (const MotorIndex m : motor_indices(map.motors())) {
        const auto tower = map.delta() ? map.delta()->tower_of(m) : std::nullopt;
        const Slopes exact = tower ? slopes_of_carriage(*map.delta(), *tower, way.direction, way.low, way.high)
                                   : Slopes{slope_of_sum(map.shares(), m, way.direction, setup.steps_per_mm), 0};
        const double gain = 1 + map.screw_share(m);
        const double bend_of_screw = map.screw(m) != nullptr ? map.screw(m)->most_bend() : 0;
        add(setup.limits[m], {gain * exact.most, gain * exact.bend + bend_of_screw * exact.most * exact.most});
    }
}

Braking Braking::of_move(const MachineConfig& machine, std::span<const AxisIndex> axes, std::span<const double> from_mm,
                         std::span<const double> to_mm) {
    Way way(machine);
    double length = 0;
    for (std::size_t k = 0; k < axes.size(); ++k) { length = std::hypot(length, to_mm[k] - from_mm[k]); }
    for (std::size_t k = 0; k < axes.size(); ++k) {
        way.direction[axes[k]] = length > 0 ? (to_mm[k] - from_mm[k]) / length : 0;
        way.low[axes[k]] = std::min(from_mm[k], to_mm[k]);
        way.high[axes[k]] = std::max(from_mm[k], to_mm[k]);
    }
    return Braking(machine, way);
}

Braking Braking::of_axis(const MachineConfig& machine, AxisIndex axis) {
    Way way(machine);
    way.direction[axis] = 1;
    return Braking(machine, way);
}

double Braking::mm_s2(double speed_mm_s) const {
    double most = std::numeric_limits<double>::max();
    for (const Row& row : rows_) {
        most = std::min(most, row.at_rest_mm_s2 - row.per_square * speed_mm_s * speed_mm_s);
    }
    return std::max(0.0, most);
}

bool Braking::is_constant() const {
    return std::ranges::all_of(rows_, [](const Row& row) { return row.per_square == 0; });
}

}  // namespace lockstep
