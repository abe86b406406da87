#include "core/kinematics/motor_inputs.hpp"

#include <algorithm>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

std::uint32_t bit_of(const InputConfig& input) { return std::uint32_t{1} << input.channel; }

bool may_cause(const InputConfig& input, FaultCode fault) {
    switch (fault) {
        case FaultCode::EmergencyStopInput: return input.use == InputUse::EmergencyStop;
        case FaultCode::TouchInMotion:
        case FaultCode::TouchMissed: return input.use == InputUse::Probe;
        case FaultCode::LimitHit: return input.is_limit();
        default: return false;
    }
}

std::string motor_in_fault(const MachineConfig& machine, const InputConfig& input) {
    return input.is_limit_by_message() ? motor_name(machine, motor_at_limit(machine, input)) : input.motor;
}

}  // namespace

std::uint32_t inputs_with(const MachineConfig& machine, std::string_view motor, InputUse use) {
    std::uint32_t inputs = 0;
    for (const InputConfig& input : machine.inputs) {
        inputs |= input.motor == motor && input.use == use ? bit_of(input) : 0;
    }
    return inputs;
}

std::optional<std::uint32_t> input_at(const MachineConfig& machine, std::string_view motor, int channel) {
    for (std::uint32_t i = 0; i < machine.inputs.size(); ++i) {
        if (machine.inputs[i].motor == motor && machine.inputs[i].channel == channel) { return i; }
    }
    return std::nullopt;
}

std::string label_of(const InputConfig& input) {
    return "input " + input.name + (input.at_board ? " of board " : " of motor ") + input.motor;
}

std::string causes_of(const MachineConfig& machine, std::string_view motor, FaultCode fault) {
    std::string text;
    for (const InputConfig& input : machine.inputs) {
        if (!may_cause(input, fault) || motor_in_fault(machine, input) != motor) { continue; }
        text += (text.empty() ? "" : " or ") + label_of(input);
    }
    return text;
}

MotorIndex motor_at_limit(const MachineConfig& machine, const InputConfig& input) {
    const auto axis = machine.axis_named(input.axis);
    const auto motors = motors_of(machine);
    const auto first = std::ranges::find(motors, axis, &MotorConfig::axis);
    return MotorIndex{static_cast<std::size_t>(first - motors.begin())};
}

MotorInputs::MotorInputs(const MachineConfig& machine) {
    for (const InputConfig& input : machine.inputs) {
        places_.push_back({motor_named(machine, input.motor).value_or(MotorIndex{}), bit_of(input), input.use});
    }
}

}  // namespace lockstep
