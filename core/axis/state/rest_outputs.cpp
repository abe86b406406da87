#include "core/axis/state/rest_outputs.hpp"

#include "core/kinematics/motors.hpp"
#include "core/outputs/output_levels.hpp"

namespace lockstep {

RestOutputs::RestOutputs(MotorIndex motor, const MachineConfig& machine)
    : outputs_(outputs_of(machine.outputs, motor_name(machine, motor))) {
    std::erase_if(outputs_, &OutputConfig::makes_pulses);  // they are made only while it follows frames
}

/// An output that goes off at an interruption is on again when the motion goes on, and not before.
bool RestOutputs::is_off(const OutputConfig& output, const Axis& axis) const {
    const bool is_safe = axis.is_safe && owner_->phase != MachinePhase::Fault;
    if (!is_safe && !output.stays_at_fault) { return true; }
    return !output.stays_at_interruption && owner_->phase != MachinePhase::Idle;
}

std::optional<device::ChangeOutputs> RestOutputs::change(const Axis& axis) {
    if (none() || !owner_ || axis.device.moving || axis.device.host_silent) { return std::nullopt; }
    const bool is_known = owner_->devices_after && axis.epoch <= *owner_->devices_after;
    if (!is_known && axis.is_safe) { return std::nullopt; }
    device::ChangeOutputs wanted;
    for (const OutputConfig& output : outputs_) {
        const bool off = is_off(output, axis);
        if (!is_known && !off) { continue; }
        if (!output.is_analog()) {
            wanted.digital.mask |= output.bit();
            if (!off && is_on(output, owner_->devices)) { wanted.digital.levels |= output.bit(); }
        } else {
            const bool rests = off || follows_speed(output, owner_->devices);
            wanted.analog.append({.channel = static_cast<std::uint8_t>(output.channel),
                                  .value = rests ? 0 : analog_value(share_of(output, owner_->devices)),
                                  .slope = 0});
        }
    }
    const bool is_shown = ((axis.device.outputs ^ wanted.digital.levels) & wanted.digital.mask) == 0;
    if (is_shown && ordered_ && *ordered_ == wanted) { return std::nullopt; }
    ordered_ = wanted;
    return wanted;
}

}  // namespace lockstep
