// How a verb says that the coordinator has refused its command.
#pragma once

#include "clients/text/exit_code.hpp"
#include "clients/text/voice.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// The reason and the remedy, or a CommandReport with both.
ExitCode say_refusal(const Reply& reply, Voice& voice);

}  // namespace lockstep
