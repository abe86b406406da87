#include "services/documents/rules/owner_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

/// A board in the place of a motor, or a motor in the place of a board.
std::string remedy_of(const MachineConfig& machine, const DeviceOwner& owner) {
    if (!motor_named(machine, owner.name)) { return ""; }
    return owner.is_board ? fmt::format("; motor {0} is no board: write motor: \"{0}\"", owner.name)
                          : fmt::format("; {0} is a board: write board: \"{0}\"", owner.name);
}

}  // namespace

void check_owner(const MachineConfig& machine, const DeviceOwner& owner, const std::string& at, ProblemList& problems) {
    const std::vector<std::string> all = motor_names(machine);
    const auto first_board = all.begin() + static_cast<std::ptrdiff_t>(moving_motor_count(machine));
    const std::vector<std::string> names(owner.is_board ? first_board : all.begin(),
                                         owner.is_board ? all.end() : first_board);
    const std::string key = at + (owner.is_board ? "board" : "motor");
    problems.require(std::ranges::find(names, owner.name) != names.end(), key,
                     fmt::format("{} is \"{}\"; it must be one of the machine's {}: {}{}", key, owner.name,
                                 owner.is_board ? "boards" : "motors",
                                 names.empty() ? "it has none" : fmt::format("{}", fmt::join(names, ", ")),
                                 remedy_of(machine, owner)));
}

}  // namespace lockstep
