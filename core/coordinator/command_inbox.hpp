// Clients' commands: each is answered once, and its answer is repeated to a client that repeats the command.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/protocol/client_memory.hpp"

namespace lockstep {

class CommandInbox {
public:
    void receive(std::span<const Command> commands) {
        received_.insert(received_.end(), commands.begin(), commands.end());
    }
    /// Those that were not taken yet.
    std::vector<Command> take() { return std::exchange(received_, {}); }

    /// The newest answer to the command's client, where that is for this command or a later one. Null: it is new.
    const Reply* answer_to(const Command& command) const {
        const Reply* const last = replies_.find(command.client);
        return last != nullptr && command.sequence <= last->sequence ? last : nullptr;
    }
    void note(const Reply& reply) { replies_.note(reply.client, reply); }

private:
    std::vector<Command> received_;
    ClientMemory<Reply> replies_;  // the last one to each client
};

}  // namespace lockstep
