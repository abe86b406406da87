// How a service joins: errors in its keys are reported at its start, and peers that DDS refuses later go to its log.
#pragma once

#include <chrono>
#include <expected>
#include <string>

#include "core/machine.hpp"
#include "services/security/rights.hpp"
#include "services/wire/dds/participant.hpp"

namespace lockstep {

/// Call it after open_log. Error: as admit.
std::expected<Membership, std::string> admit_service(const MachineConfig& machine, const Member& member);

/// Call it in each loop: writes unauthenticated peers to the log.
void log_unauthenticated_peers(std::chrono::nanoseconds now);

}  // namespace lockstep
