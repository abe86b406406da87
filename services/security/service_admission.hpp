// How a service joins: what is wrong with its keys is said at its start, and whom DDS refuses later goes to its log.
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

/// To be called in each loop: who has come and not proved to belong here goes to the log.
void log_strangers(std::chrono::nanoseconds now);

}  // namespace lockstep
