// Whether a command that was accepted has had its effect.
#pragma once

#include <expected>
#include <string>

#include "clients/session/session.hpp"

namespace lockstep {

/// Waits until the machine's state shows the effect, some seconds at most: a hold and a stop have brought it to rest, a
/// reset has ended its Fault. Error: it has not, with what the machine does instead and what to do.
std::expected<MachinePhase, std::string> await_effect(Session& session, CommandKind command);

}  // namespace lockstep
