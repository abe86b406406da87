// Lets a service join its machine. It reports errors in the service's keys at the start, and logs peers that DDS
// refuses later.
#pragma once

#include <chrono>
#include <expected>
#include <string>

#include "services/security/rights.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/wire/dds/participant.hpp"

namespace lockstep {

/// Call it after open_log. Error: as admit.
std::expected<Membership, std::string> admit_service(const MachineSetup& machine, const Member& member);

/// Call it in each loop. Writes unauthenticated peers to the log, and the end of this process's keys: once a day in the
/// last thirty days, and when they have expired.
void log_security(std::chrono::nanoseconds now);

}  // namespace lockstep
