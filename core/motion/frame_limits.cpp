#include "core/motion/frame_limits.hpp"

namespace lockstep {

AxisLimits frame_limits_of(const MachineConfig& machine, std::size_t axis) {
    AxisLimits limits = limits_of(machine.axes[axis], machine.tick_ns);
    if (machine.timing.time_source != TimeSource::Network) { return limits; }
    limits.max_velocity *= 1 - clock_reserve::kSpeed;
    limits.start_velocity *= 1 - clock_reserve::kAcceleration;
    limits.max_acceleration *= 1 - clock_reserve::kAcceleration;
    limits.max_deceleration *= 1 - clock_reserve::kAcceleration;
    return limits;
}

std::vector<AxisLimits> frame_limits_of(const MachineConfig& machine) {
    std::vector<AxisLimits> limits;
    limits.reserve(machine.axes.size());
    for (std::size_t i = 0; i < machine.axes.size(); ++i) { limits.push_back(frame_limits_of(machine, i)); }
    return limits;
}

}  // namespace lockstep
