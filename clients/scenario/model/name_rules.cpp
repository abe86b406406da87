#include "clients/scenario/model/name_rules.hpp"

#include "core/faults.hpp"

namespace lockstep::scenario {

void require_axis(Problems& problems, const MachineConfig& machine, const std::string& path, const std::string& name) {
    problems.require_one_of(path, name, machine.axis_names(), "axis");
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
