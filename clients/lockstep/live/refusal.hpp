// How a verb says that the coordinator has refused its command.
#pragma once

#include "clients/lockstep/exit_code.hpp"
#include "clients/lockstep/live/voice.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// The reason and the remedy, or a CommandReport with both.
ExitCode say_refusal(const Reply& reply, Voice& voice);

}  // namespace lockstep
