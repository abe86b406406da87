#include "core/coordinator/path/probe_cease.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/kinematics/motors.hpp"
#include "core/overrides.hpp"

namespace lockstep {
namespace {

using Inputs = std::vector<const InputConfig*>;

/// From the touch until the pulses cease: the input follows its pin, and the device looks at it at the next tick.
double seconds_until_ceased(const MachineConfig& machine, const InputConfig& input) {
    return input.debounce_ms * 1e-3 + 2 / machine.ticks_per_second();
}

/// The inputs see the same switch: there is only one input, or all are of one wire.
bool are_one_switch(const Inputs& inputs) {
    const auto is_of_wire = [&](const InputConfig* input) { return input->wire == inputs.front()->wire; };
    return inputs.size() == 1 || (!inputs.front()->wire.empty() && std::ranges::all_of(inputs, is_of_wire));
}

/// How much faster than the move a motor is at most, in any direction of the move.
double greatest_gain(const LinearMap& map, MotorIndex motor, AxisSet axes) {
    double gain = 0;
    for (const AxisIndex i : axes) { gain = std::hypot(gain, map.factor(motor, i)); }
    return gain;
}

/// There are more motors than axes, so the counts of an axis's motors must agree. With clocks of their own their pulses
/// would cease within the errors of these clocks, and they might rest a step apart.
bool must_count_one_clock(MotorSet motors, const Kinematics& kinematics) {
    AxisSet axes;
    for (const MotorIndex m : motors) { axes |= kinematics.axes_of_motor(m); }
    return motors.size() > axes.size();
}

/// The greatest speed of a move of these axes at whose touch the pulses of all its motors can cease, each by the input
/// at its own device; nullopt: a motor has none, or takes other steps than its axes, or could rest a step off.
std::optional<double> greatest_speed_mm_s(const Probe& probe, AxisSet axes, const MachineConfig& machine,
                                          const Kinematics& kinematics) {
    const Inputs inputs = inputs_of_probe(machine.inputs, probe.input);
    const MotorSet motors = kinematics.motors_of_axes(axes);
    if (motors.empty() || inputs.empty() || !are_one_switch(inputs)) { return std::nullopt; }
    const bool need_one_clock = must_count_one_clock(motors, kinematics);
    const LinearMap map = motor_map_of(machine);
    double most = std::numeric_limits<double>::max();
    for (const MotorIndex m : motors) {
        const MotorConfig& motor = kinematics.motors()[m];
        const auto is_at_motor = [&](const InputConfig* input) { return input->motor == motor.name; };
        const bool may_rest_off = need_one_clock && estimates_clock(machine, m);
        const bool takes_other_steps = kinematics.corrects_screw(m) || !motor.backlash.is_none();
        if (std::ranges::none_of(inputs, is_at_motor) || may_rest_off || takes_other_steps) { return std::nullopt; }
        most = std::min(most, motor.start_velocity_mm_s / greatest_gain(map, m, axes));
    }
    return most;
}

}  // namespace

bool ceases_at_touch(const Probe& probe, const ProgramMove& move, AxisSet axes, const MachineConfig& machine,
                     const Kinematics& kinematics) {
    const auto most = greatest_speed_mm_s(probe, axes, machine, kinematics);
    return most && !move.rapid && move.feed_mm_s * greatest_override(move) <= *most;
}

double greatest_override(const ProgramMove& move) { return move.is_feed_fixed ? 1 : Overrides::kMost / 100.0; }

double ceased_overshoot_mm(const MachineConfig& machine, const InputConfig& input, AxisSet axes,
                           const Kinematics& kinematics, double feed_mm_s) {
    double step_mm = 0;
    for (const AxisIndex i : axes) { step_mm = std::hypot(step_mm, kinematics.step_mm(i)); }
    return feed_mm_s * seconds_until_ceased(machine, input) + step_mm;
}

std::optional<double> greatest_ceasing_feed_mm_s(const Probe& probe, const InputConfig& input, AxisSet axes,
                                                 const MachineConfig& machine, const Kinematics& kinematics) {
    const auto most = greatest_speed_mm_s(probe, axes, machine, kinematics);
    if (!most) { return std::nullopt; }
    const double way_mm = input.max_overshoot_mm - ceased_overshoot_mm(machine, input, axes, kinematics, 0);
    return std::min(*most, way_mm / seconds_until_ceased(machine, input));
}

}  // namespace lockstep
