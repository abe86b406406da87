// What a service asks of its host's scheduler and memory, and what came of it.
#pragma once

#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

/// Asks for what is configured, for this thread and those it starts after: call it before a DDS participant is made.
/// Each line says what was granted, or what was not, what that costs, and the remedy. Where nothing is asked: none.
std::vector<std::string> ask_for_real_time(const RealTimeConfig& wanted);

/// This thread need not be in time: it goes back to the normal scheduler.
void leave_real_time();

}  // namespace lockstep
