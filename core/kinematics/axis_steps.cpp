#include "core/kinematics/axis_steps.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/kinematics/motors.hpp"

namespace lockstep {

void set_steps_of_axes(MachineConfig& machine) {
    constexpr double kFiner = 16;
    const LinearMap map = motor_map_of(machine);
    std::vector<double> finest(machine.axes.size(), 0.0);
    std::vector<bool> is_simple(machine.axes.size(), true);
    const std::vector<MotorConfig> motors = motors_of(machine);
    for (std::size_t m = 0; m < map.motors(); ++m) {
        for (std::size_t i = 0; i < machine.axes.size(); ++i) {
            const double share = map.factor(m, i);
            if (share == 0) { continue; }
            const double steps = std::abs(share) * motors[m].steps_per_mm;
            const bool follows = std::abs(share) == 1 && map.only_axis_of(m) == i && motors[m].screw.is_exact();
            is_simple[i] = is_simple[i] && follows && (finest[i] == 0 || finest[i] == steps);
            finest[i] = std::max(finest[i], steps);
        }
    }
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        AxisConfig& axis = machine.axes[i];
        const double before = axis.steps_per_mm;
        if (finest[i] > 0) { axis.steps_per_mm = is_simple[i] ? finest[i] : kFiner * finest[i]; }
        if (is_simple[i] || !axis.motors.empty()) { continue; }
        axis.motors.push_back(
            {.name = axis.name, .host = axis.host, .device = axis.device, .steps_per_mm = before, .plant = {}});
    }
}

}  // namespace lockstep
