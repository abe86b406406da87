// What of a machine's status a person should look at, in sentences, the worst first. Pure.
#pragma once

#include <string>
#include <vector>

#include "clients/lockstep/status/watch_text.hpp"

namespace lockstep {

/// Faults with their remedies, axes that are not heard, setpoints after their deadline, steps beside their time, and
/// everything that was refused or lost. Empty: all is well.
std::vector<std::string> alarms_of(const proto::StatusReport& status, const SlackScale& scale);

}  // namespace lockstep
