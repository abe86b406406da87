// The control groups in which this process's containers are: the kernel keeps them when a world is gone.
#pragma once

#include <string>

namespace lockstep::scenario {

/// By the number of this process, which is outside of any world.
std::string own_control_group();

/// Takes away this process's, and those of processes that are no more, once nothing is in them.
void remove_control_groups();

}  // namespace lockstep::scenario
