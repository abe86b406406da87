#include "core/kinematics/motor_inputs.hpp"

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

std::uint32_t bit_of(const InputConfig& input) { return std::uint32_t{1} << input.channel; }

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

std::string labels_of(const MachineConfig& machine, std::string_view motor, InputUse use) {
    std::string text;
    for (const InputConfig& input : machine.inputs) {
        if (input.motor != motor || input.use != use) { continue; }
        text += (text.empty() ? "" : " or ") + label_of(input);
    }
    return text;
}

MotorInputs::MotorInputs(const MachineConfig& machine) {
    for (const InputConfig& input : machine.inputs) {
        places_.push_back({motor_named(machine, input.motor).value_or(0), bit_of(input), input.use, input.number});
    }
}

}  // namespace lockstep
