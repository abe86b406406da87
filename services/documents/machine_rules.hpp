// The rules for a valid configuration.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// A key of the configuration, such as "tick_ns", "timing.slot_us", or "homing.pulloff_mm" of axis i. An empty key
/// means the whole block.
struct FieldPath {
    std::optional<std::size_t> axis;
    std::string key;
    bool operator==(const FieldPath&) const = default;
};

struct Problem {
    FieldPath field;
    std::string message;  // the value, the limit and the remedy
};

/// Checks all keys outside the axes, such as timing and network.
std::vector<Problem> machine_problems(const MachineSetup& machine);

/// Checks the keys of one axis, and that no axis before it has the same name.
std::vector<Problem> axis_problems(const MachineConfig& machine, std::size_t axis);

/// Checks the motor blocks of one axis.
std::vector<Problem> motor_problems(const MachineConfig& machine, std::size_t axis);

/// Checks the boards and their names, after all axes and motors were found sound.
std::vector<Problem> board_problems(const MachineConfig& machine);

/// Checks the errors of screws, after all axes and motors were found sound.
std::vector<Problem> screw_problems(const MachineConfig& machine);

/// Checks which lost steps motors make up, after the kinematics were found sound.
std::vector<Problem> correction_problems(const MachineConfig& machine);
/// Checks the backlash of motors, after the kinematics were found sound.
std::vector<Problem> backlash_problems(const MachineConfig& machine);

/// Checks the boards behind links, and the motors whose devices they have, after all boards were found sound.
std::vector<Problem> board_link_problems(const MachineSetup& machine);

/// Checks which motors move which axes, after all axes and motors were found sound.
std::vector<Problem> kinematics_problems(const MachineConfig& machine);

/// Checks the pulses of motors against their speeds, after all that was found sound.
std::vector<Problem> pin_problems(const MachineConfig& machine);

/// Checks the outputs, after all motors were found sound.
std::vector<Problem> output_problems(const MachineConfig& machine);

/// Checks the inputs, after all motors were found sound.
std::vector<Problem> input_problems(const MachineConfig& machine);

/// Checks the simulated workpiece, after all inputs were found sound.
std::vector<Problem> workpiece_problems(const MachineConfig& machine);

}  // namespace lockstep
