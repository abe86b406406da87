// Emergency stops of clients. A client repeats a stop until it is answered, but each stop acts on the axis only once.
#pragma once

#include "core/protocol/client_memory.hpp"

namespace lockstep {

class ClientStops {
public:
    /// Whether this is an emergency stop that was not taken before.
    bool take(const Command& command) {
        if (command.kind != CommandKind::EmergencyStop) { return false; }
        const std::uint64_t* const last = taken_.find(command.client);
        if (last != nullptr && command.sequence <= *last) { return false; }
        taken_.note(command.client, command.sequence);
        return true;
    }

private:
    ClientMemory<std::uint64_t> taken_;  // the newest of each client
};

}  // namespace lockstep
