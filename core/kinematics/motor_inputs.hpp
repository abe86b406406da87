// The machine's inputs by the motors whose devices have them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/faults.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// The inputs of the motor's device that have this use; input n is bit n.
std::uint32_t inputs_with(const MachineConfig& machine, std::string_view motor, InputUse use);

/// The place in the machine's file of the input at this channel of the motor's device; nullopt if there is none.
std::optional<std::uint32_t> input_at(const MachineConfig& machine, std::string_view motor, int channel);

/// For texts: "input stop of motor X", or "input door of board IO".
std::string label_of(const InputConfig& input);

/// The same for all inputs that can cause this fault of a motor: "input stop of motor X or input gate of motor X".
/// Empty: none can.
std::string causes_of(const MachineConfig& machine, std::string_view motor, FaultCode fault);

/// The number of the first motor of the axis that an input names, a limit switch.
MotorIndex motor_at_limit(const MachineConfig& machine, const InputConfig& input);

/// Where the machine's inputs are: each by the number of its motor, in the order of the machine's file.
class MotorInputs {
public:
    explicit MotorInputs(const MachineConfig& machine);

    /// The number of the first input with this use that is closed; nullopt if there is none. `closed_of(motor)`: the
    /// closed inputs of the motor's device, 0 if they are not known.
    template <typename ClosedOf>
    std::optional<std::size_t> closed(InputUse use, ClosedOf&& closed_of) const {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (places_[i].use == use && is_closed(i, closed_of)) { return i; }
        }
        return std::nullopt;
    }
    /// Whether this input of the machine is closed.
    template <typename ClosedOf>
    bool is_closed(std::size_t input, ClosedOf&& closed_of) const {
        return (closed_of(places_[input].motor) & places_[input].bit) != 0;
    }
    MotorIndex motor(std::size_t input) const { return places_[input].motor; }

private:
    struct Place {
        MotorIndex motor;
        std::uint32_t bit = 0;
        InputUse use = InputUse::Program;
    };
    std::vector<Place> places_;
};

}  // namespace lockstep
