// Clients' commands: each is answered once, and its answer is repeated to a client that repeats the command.
#pragma once

#include <span>

#include "core/protocol/client_memory.hpp"
#include "core/reused_vector.hpp"

namespace lockstep {

class CommandInbox {
public:
    void receive(std::span<const Command> commands) {
        for (const Command& command : commands) { received_.append() = command; }
    }
    /// Calls visit(command) for each that was not taken yet.
    template <typename Visit>
    void take_each(Visit visit) {
        for (const Command& command : received_) { visit(command); }
        received_.clear();
    }

    /// The newest answer to the command's client, where that is for this command or a later one. Null: it is new.
    const Reply* answer_to(const Command& command) const {
        const Reply* const last = replies_.find(command.client);
        return last != nullptr && command.sequence <= last->sequence ? last : nullptr;
    }
    void note(const Reply& reply) { replies_.note(reply.client, reply); }

private:
    ReusedVector<Command> received_;
    ClientMemory<Reply> replies_;  // the last one to each client
};

}  // namespace lockstep
