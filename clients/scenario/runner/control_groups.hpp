// The control groups of this process's containers. The kernel keeps them after a sandbox has ended.
#pragma once

#include <string>

namespace lockstep::scenario {

/// Named by the id of this process, which is outside of any sandbox.
std::string own_control_group();

/// Removes the groups of this process and of ended processes, once they are empty.
void remove_control_groups();

}  // namespace lockstep::scenario
