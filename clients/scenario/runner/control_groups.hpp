// The control groups of this process's containers: the kernel keeps them after a sandbox has ended.
#pragma once

#include <string>

namespace lockstep::scenario {

/// Named by the id of this process, which is outside of any sandbox.
std::string own_control_group();

/// Removes those of this process and of processes that have ended, once they are empty.
void remove_control_groups();

}  // namespace lockstep::scenario
