#include "clients/scenario/model/name_rules.hpp"

#include <algorithm>

#include "core/faults.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep::scenario {

void require_axis(Problems& problems, const MachineConfig& machine, const std::string& path, const std::string& name) {
    problems.require_one_of(path, name, machine.axis_names(), "axis");
}

const char* word_for_motors(const MachineConfig& machine) {
    const bool are_axes = moving_motor_names(machine) == machine.axis_names();
    if (!machine.boards.empty()) { return are_axes ? "axis or board" : "motor or board"; }
    return are_axes ? "axis" : "motor";
}

void require_motor(Problems& problems, const MachineConfig& machine, const std::string& path, const std::string& name) {
    problems.require_one_of(path, name, motor_names(machine), word_for_motors(machine));
}

void require_axis_or_motor(Problems& problems, const MachineConfig& machine, const std::string& path,
                           const std::string& name) {
    std::vector<std::string> names = machine.axis_names();
    for (const std::string& motor : motor_names(machine)) {
        if (std::ranges::find(names, motor) == names.end()) { names.push_back(motor); }
    }
    problems.require_one_of(path, name, names, names == machine.axis_names() ? "axis" : "axis or motor");
}

void require_place(Problems& problems, const MachineConfig& machine, const std::string& path,
                   const Asked::Target& target) {
    require_axis(problems, machine, path + ".axis", target.axis());
    const auto axis = std::ranges::find(machine.axes, target.axis(), &AxisConfig::name);
    if (axis == machine.axes.end()) { return; }
    problems.require(target.has_mm(), path, "mm is missing; set the position in machine coordinates");
    if (target.has_mm()) {
        problems.require_range(path, "mm", target.mm(), axis->position_min_mm, axis->position_max_mm);
    }
}

void require_fault(Problems& problems, const std::string& path, const std::string& name, bool may_be_none) {
    const bool is_one = find_fault(name) != nullptr || (may_be_none && name == "none");
    problems.require(is_one, path,
                     "there is no fault '" + name + "'; use its name in lockstep status, such as axis-lost");
}

}  // namespace lockstep::scenario
