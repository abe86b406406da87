// Reports that the coordinator has refused a command.
#pragma once

#include "clients/text/exit_code.hpp"
#include "clients/text/output.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// Prints the reason and the remedy, or a CommandReport with both.
ExitCode print_refusal(const Reply& reply, Output& output);

}  // namespace lockstep
