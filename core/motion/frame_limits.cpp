#include "core/motion/frame_limits.hpp"

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

template <Moving Part>
AxisLimits with_reserves(const MachineConfig& machine, const Part& part) {
    AxisLimits limits = limits_of(part, machine.tick_ns);
    if (machine.timing.time_source != TimeSource::Network) { return limits; }
    limits.max_velocity *= 1 - clock_reserve::kSpeed;
    limits.start_velocity *= 1 - clock_reserve::kAcceleration;
    limits.max_acceleration *= 1 - clock_reserve::kAcceleration;
    limits.max_deceleration *= 1 - clock_reserve::kAcceleration;
    return limits;
}

template <Moving Part>
std::vector<AxisLimits> all_with_reserves(const MachineConfig& machine, const std::vector<Part>& parts) {
    std::vector<AxisLimits> limits;
    limits.reserve(parts.size());
    for (const Part& part : parts) { limits.push_back(with_reserves(machine, part)); }
    return limits;
}

}  // namespace

AxisLimits frame_limits_of(const MachineConfig& machine, std::size_t motor) {
    return with_reserves(machine, motors_of(machine)[motor]);
}

std::vector<AxisLimits> frame_limits_of(const MachineConfig& machine) {
    return all_with_reserves(machine, motors_of(machine));
}

std::vector<AxisLimits> axis_frame_limits_of(const MachineConfig& machine) {
    return all_with_reserves(machine, machine.axes);
}

}  // namespace lockstep
