#include "core/machine.hpp"

#include <algorithm>

namespace lockstep {

std::vector<std::string> MachineConfig::axis_names() const {
    std::vector<std::string> names;
    for (const AxisConfig& axis : axes) { names.push_back(axis.name); }
    return names;
}

std::optional<AxisIndex> MachineConfig::axis_named(std::string_view wanted) const {
    for (const AxisIndex axis : axis_indices(axes.size())) {
        if (axes[axis].name == wanted) { return axis; }
    }
    return std::nullopt;
}

bool MachineConfig::estimates_clocks() const {
    if (timing.time_source == TimeSource::Network) { return true; }
    const auto is_on_own_clock = [](const BoardConfig& board) { return board.device.has_own_clock(); };
    return std::ranges::any_of(boards, is_on_own_clock) || std::ranges::any_of(axes, [](const AxisConfig& axis) {
               const auto has_own = [](const MotorBlock& motor) { return motor.device.has_own_clock(); };
               return axis.motors.empty() ? axis.device.has_own_clock() : std::ranges::any_of(axis.motors, has_own);
           });
}

}  // namespace lockstep
