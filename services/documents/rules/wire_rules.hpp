// The rules of a wire: inputs of several devices that see the same switch, so all but their pins is the same.
#pragma once

#include <cstddef>
#include <string>

#include "core/machine.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {

/// `number`: of the input in the machine's file. at: its place, such as "input[0].".
void check_wire(const MachineConfig& machine, std::size_t number, const std::string& at, ProblemList& problems);

}  // namespace lockstep
