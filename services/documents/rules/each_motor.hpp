// Applies the rules of motors, which know their axis, to all motors of a machine.
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "core/machine.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {

/// `Rules` is made of the machine and the number of an axis. Its check() takes the number of a motor and of its block
/// in the axis, or nullopt if it has no block.
template <typename Rules>
std::vector<Problem> problems_of_motors(const MachineConfig& machine) {
    std::vector<Problem> found;
    MotorIndex motor;
    for (const AxisIndex axis : axis_indices(machine.axes.size())) {
        Rules rules(machine, axis);
        const std::size_t blocks = machine.axes[axis].motors.size();
        if (blocks == 0) {
            rules.check(motor, std::nullopt);
            ++motor;
        }
        for (std::size_t k = 0; k < blocks; ++k, ++motor) { rules.check(motor, k); }
        std::ranges::move(rules.take(), std::back_inserter(found));
    }
    return found;
}

}  // namespace lockstep
