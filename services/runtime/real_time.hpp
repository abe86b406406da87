// A service's requests to its host's scheduler and memory, and their results.
#pragma once

#include <string>
#include <vector>

#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// Requests the configured scheduling and memory locking for this thread and those that it starts later. Call it before
/// creating a DDS participant. Each line of the result says what was granted, or what was refused, its effect, and the
/// remedy.
std::vector<std::string> ask_for_real_time(const RealTimeConfig& wanted);

/// Returns this thread, which has no deadlines, to the normal scheduler.
void leave_real_time();

}  // namespace lockstep
