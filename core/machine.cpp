#include "core/machine.hpp"

#include <cmath>

namespace lockstep {

std::vector<std::string> MachineConfig::axis_names() const {
    std::vector<std::string> names;
    for (const AxisConfig& axis : axes) { names.push_back(axis.name); }
    return names;
}

AxisLimits limits_of(const AxisConfig& axis, std::int64_t tick_ns) {
    const double tick_s = static_cast<double>(tick_ns) * 1e-9;
    const double per_tick = axis.steps_per_mm * tick_s;
    return {
        .start_velocity = axis.start_velocity_mm_s * per_tick,
        .max_velocity = axis.max_velocity_mm_s * per_tick,
        .max_acceleration = axis.max_accel_mm_s2 * per_tick * tick_s,
        .max_deceleration = axis.max_decel_mm_s2 * per_tick * tick_s,
        .min_steps = to_steps(axis, axis.position_min_mm),
        .max_steps = to_steps(axis, axis.position_max_mm),
    };
}

std::int64_t to_steps(const AxisConfig& axis, double mm) { return std::llround(mm * axis.steps_per_mm); }

double to_mm(const AxisConfig& axis, double steps) { return steps / axis.steps_per_mm; }

}  // namespace lockstep
