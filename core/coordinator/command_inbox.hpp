// Commands of clients. Each is carried out once. If a client repeats a command, it gets the same answer again.
#pragma once

#include <span>

#include "core/protocol/client_memory.hpp"
#include "core/reused_vector.hpp"

namespace lockstep {

class CommandInbox {
public:
    void receive(std::span<const Command> commands) {
        for (const Command& command : commands) { received_.push_back(command); }
    }
    /// Calls visit(command) for each that was not taken yet.
    template <typename Visit>
    void take_each(Visit visit) {
        for (const Command& command : received_) { visit(command); }
        received_.clear();
    }

    /// Returns the newest answer to the command's client if it is for this command or a later one, or null if the
    /// command is new.
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
