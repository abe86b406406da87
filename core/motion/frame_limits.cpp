#include "core/motion/frame_limits.hpp"

#include <algorithm>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

template <Moving Part>
AxisLimits with_reserves(const MachineConfig& machine, const Part& part, bool estimates_clock) {
    AxisLimits limits = limits_of(part, machine.tick_ns);
    if (!estimates_clock) { return limits; }
    limits.max_velocity *= 1 - clock_reserve::kSpeed;
    limits.start_velocity *= 1 - clock_reserve::kAcceleration;
    limits.max_acceleration *= 1 - clock_reserve::kAcceleration;
    limits.max_deceleration *= 1 - clock_reserve::kAcceleration;
    return limits;
}

}  // namespace

AxisLimits frame_limits_of(const MachineConfig& machine, MotorIndex motor) {
    return with_reserves(machine, motors_of(machine)[motor], estimates_clock(machine, motor));
}

std::vector<AxisLimits> frame_limits_of(const MachineConfig& machine) {
    std::vector<AxisLimits> limits;
    for (const MotorConfig& motor : motors_of(machine)) {
        limits.push_back(with_reserves(machine, motor, estimates_clock(machine, MotorIndex{limits.size()})));
    }
    return limits;
}

std::vector<AxisLimits> axis_frame_limits_of(const MachineConfig& machine) {
    std::vector<AxisLimits> limits;
    for (const AxisConfig& axis : machine.axes) {
        limits.push_back(with_reserves(machine, axis, machine.estimates_clocks()));
    }
    return limits;
}

AxisCounts within_travel(AxisCounts at, std::span<const AxisLimits> axes) {
    for (std::size_t i = 0; i < at.size(); ++i) { at[i] = std::clamp(at[i], axes[i].min_steps, axes[i].max_steps); }
    return at;
}

}  // namespace lockstep
