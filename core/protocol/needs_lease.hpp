// Which commands are the writer's alone.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

/// False: it only makes the machine safer, and is everybody's.
inline bool needs_lease(const Command& command) {
    switch (command.kind) {
        case CommandKind::Hold:
        case CommandKind::Stop:
        case CommandKind::EmergencyStop: return false;
        case CommandKind::Jog: return !command.jogs.empty();
        default: return true;
    }
}

}  // namespace lockstep
