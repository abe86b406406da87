#include "core/coordinator/path/probe_cease.hpp"

#include <algorithm>

#include "core/kinematics/motors.hpp"
#include "core/overrides.hpp"

namespace lockstep {
namespace {

/// From the touch until the pulses cease: the input follows its pin, and the device looks at it at the next tick.
double seconds_until_ceased(const MachineConfig& machine, const InputConfig& input) {
    return input.debounce_ms * 1e-3 + 2 / machine.ticks_per_second();
}

/// The motor whose pulses can cease at a touch while it moves only this axis, by the axis's own steps; nullopt: the
/// probe has inputs at other devices, or other motors move too.
std::optional<MotorIndex> motor_that_may_cease(const Probe& probe, AxisIndex axis, const MachineConfig& machine,
                                               const Kinematics& kinematics) {
    const auto inputs = inputs_of_probe(machine.inputs, probe.input);
    const auto motor = kinematics.own_motor(axis);
    if (!motor || inputs.size() != 1 || kinematics.corrects_screw(*motor)) { return std::nullopt; }
    return motor_named(machine, inputs.front()->motor) == motor ? motor : std::nullopt;
}

}  // namespace

bool ceases_at_touch(const Probe& probe, const ProgramMove& move, AxisIndex axis, const MachineConfig& machine,
                     const Kinematics& kinematics) {
    const auto motor = motor_that_may_cease(probe, axis, machine, kinematics);
    if (!motor || move.rapid) { return false; }
    return move.feed_mm_s * greatest_override(move) <= kinematics.motors()[*motor].start_velocity_mm_s;
}

double greatest_override(const ProgramMove& move) { return move.is_feed_fixed ? 1 : Overrides::kMost / 100.0; }

double ceased_overshoot_mm(const MachineConfig& machine, const InputConfig& input, const AxisConfig& axis,
                           double feed_mm_s) {
    return feed_mm_s * seconds_until_ceased(machine, input) + 1 / axis.steps_per_mm;
}

std::optional<double> greatest_ceasing_feed_mm_s(const Probe& probe, const InputConfig& input, AxisIndex axis,
                                                 const MachineConfig& machine, const Kinematics& kinematics) {
    const auto motor = motor_that_may_cease(probe, axis, machine, kinematics);
    if (!motor) { return std::nullopt; }
    const double way_mm = input.max_overshoot_mm - 1 / machine.axes[axis].steps_per_mm;
    return std::min(kinematics.motors()[*motor].start_velocity_mm_s, way_mm / seconds_until_ceased(machine, input));
}

}  // namespace lockstep
