// Makes the reply that a client receives from the result of its command.
#pragma once

#include "core/coordinator/state/refusal.hpp"

namespace lockstep {

/// `job`: the number of the job that the command began, or that is in progress.
Reply reply_to(const Command& command, const CommandResult& result, std::uint64_t job);
/// The reply to a command that another owner has received.
Reply reply_of_new_owner(const Command& command);

/// Whether the client wants that the job in progress does not continue by itself.
bool is_interrupt(CommandKind kind);

}  // namespace lockstep
