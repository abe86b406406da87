// From the answer to a command to the reply that its client receives.
#pragma once

#include "core/coordinator/state/refusal.hpp"

namespace lockstep {

/// `job`: the number of the job that the command began, or that is in progress.
Reply reply_to(const Command& command, const CommandResult& result, std::uint64_t job);
/// To a command that another owner has received.
Reply reply_of_new_owner(const Command& command);

/// The client does not want the job in progress to go on by itself.
bool is_interrupt(CommandKind kind);

}  // namespace lockstep
