// A service's requests to its host's scheduler and memory, and their results.
#pragma once

#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

/// Requests what is configured, for this thread and those that it starts later: call it before creating a DDS
/// participant. Each line states what was granted, or what was refused, its effect, and the remedy.
std::vector<std::string> ask_for_real_time(const RealTimeConfig& wanted);

/// This thread has no deadlines: it returns to the normal scheduler.
void leave_real_time();

}  // namespace lockstep
