#include "core/kinematics/motor_map.hpp"

#include <algorithm>

namespace lockstep {
namespace {

template <typename AnIndex>
std::optional<std::size_t> place_in(const std::array<AnIndex, 3>& list, AnIndex number) {
    const auto found = std::ranges::find(list, number);
    return found == list.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - list.begin()));
}

}  // namespace

std::optional<std::size_t> MachineDelta::tower_of(MotorIndex motor) const { return place_in(motors, motor); }
std::optional<std::size_t> MachineDelta::coordinate_of(AxisIndex axis) const { return place_in(axes, axis); }

LinearMap MotorMap::slopes_at(const std::vector<double>& axes) const {
    LinearMap slopes = shares_;
    std::vector<double> change(axes.size());
    for (const AxisIndex i : axis_indices(axes.size())) {
        change[i] = 1;
        for (const MotorIndex m : motor_indices(motors())) { slopes.factor(m, i) = slope(m, axes, change); }
        change[i] = 0;
    }
    return slopes;
}

LinearMap MotorMap::motors_by_joints() const {
    LinearMap map = shares_;
    if (!delta_) { return map; }
    for (std::size_t k = 0; k < DeltaMap::kTowers; ++k) {
        for (const AxisIndex i : axis_indices(axes())) {
            map.factor(delta_->motors[k], i) = i == delta_->axes[k] ? 1 : 0;
        }
    }
    return map;
}

}  // namespace lockstep
