#include "tests/simulation/simtest/draw/machine/draw_backlash.hpp"

#include <algorithm>
#include <cmath>

#include "core/kinematics/axis_steps.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/record/motor_shares.hpp"

namespace lockstep::simtest {
namespace {

/// The rules demand half a step of the motor, and less than the pull-off. Motors of one axis home apart by their plays,
/// too, so these are small beside what the axis allows.
std::optional<BacklashConfig> draw_play(Draw& draw, const AxisConfig& axis, double steps_per_mm) {
    const bool is_together = axis.motors.size() > 1;
    const double least = 1 / steps_per_mm;
    const double most = axis.homing.pulloff_mm * (is_together ? 0.1 : 0.95);
    if (most <= least || !draw.chance(0.8)) { return std::nullopt; }
    BacklashConfig backlash{.mm = std::min(draw.magnitude(least, most), 9.0), .speed_mm_s = {}};
    if (draw.chance(0.4)) { backlash.speed_mm_s = axis.max_velocity_mm_s * draw.real(0.1, 1); }
    return backlash;
}

bool may_have_play(const AxisConfig& axis) { return axis.homing.way == HomingWay::BySwitch; }

}  // namespace

MachineConfig with_backlash(std::uint64_t seed, MachineConfig machine) {
    if (machine.coordination == StepMethod::Lai || machine.kinematics.delta) { return machine; }
    Draw draw(seed ^ 0xbac1a54000000000U);
    const MotorShares shares(machine);
    std::size_t motor = 0;
    for (AxisConfig& axis : machine.axes) {
        const std::size_t first = motor;
        motor += std::max<std::size_t>(1, axis.motors.size());
        if (!may_have_play(axis)) { continue; }
        if (axis.motors.empty()) { axis.backlash = draw_play(draw, axis, shares.steps_per_mm(first)); }
        for (std::size_t k = 0; k < axis.motors.size(); ++k) {
            axis.motors[k].backlash = draw_play(draw, axis, shares.steps_per_mm(first + k));
        }
    }
    set_steps_of_axes(machine);
    return machine;
}

}  // namespace lockstep::simtest
