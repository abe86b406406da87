// Finds the parts of a machine's status that need attention, as sentences, the worst first. Pure.
#pragma once

#include <string>
#include <vector>

#include "clients/lockstep/status/watch_text.hpp"

namespace lockstep {

/// Faults with their remedies, axes that are not received, setpoints after their deadline, steps off their time, and
/// everything that was refused or lost. Empty if there are none.
std::vector<std::string> alarms_of(const proto::StatusReport& status, const SlackScale& scale);

}  // namespace lockstep
