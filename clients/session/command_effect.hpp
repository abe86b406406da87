// Waits for the effect of an accepted command.
#pragma once

#include <expected>
#include <string>

#include "clients/session/session.hpp"

namespace lockstep {

/// Waits some seconds at most until the machine's state shows the effect: a hold or stop has brought it to rest, a
/// reset has ended its Fault. If that does not happen, the error has the machine's state and the remedy.
std::expected<MachinePhase, std::string> await_effect(Session& session, CommandKind command);

}  // namespace lockstep
