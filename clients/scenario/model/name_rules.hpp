// The rules for names and places that several blocks of a scenario have: see rules.hpp.
#pragma once

#include <string>

#include "clients/scenario/model/problems.hpp"

namespace lockstep::scenario {

/// `path`: the place of the name or of the block in the scenario.
void require_axis(Problems& problems, const MachineConfig& machine, const std::string& path, const std::string& name);
/// "motor"; "axis" if each axis has a motor of its name.
const char* word_for_motors(const MachineConfig& machine);
void require_motor(Problems& problems, const MachineConfig& machine, const std::string& path, const std::string& name);
void require_axis_or_motor(Problems& problems, const MachineConfig& machine, const std::string& path,
                           const std::string& name);
/// The axis exists, and the position is given and within its travel.
void require_place(Problems& problems, const MachineConfig& machine, const std::string& path,
                   const Asked::Target& target);
void require_fault(Problems& problems, const std::string& path, const std::string& name, bool may_be_none = false);

}  // namespace lockstep::scenario
