// The rule for `motor` and `board` of an output or an input: the machine has it.
#pragma once

#include <string>

#include "core/machine.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {

/// Whose device has an output or an input.
struct DeviceOwner {
    const std::string& name;
    bool is_board = false;
    /// For texts: "motor X" or "board IO".
    std::string text() const { return (is_board ? "board " : "motor ") + name; }
};

/// at: the place of the output or input, such as "output[0].".
void check_owner(const MachineConfig& machine, const DeviceOwner& owner, const std::string& at, ProblemList& problems);

}  // namespace lockstep
