// Which commands only the writer may give, and which are about its lease.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

/// False if the command only makes the machine safer. Every client may give such a command.
inline bool needs_lease(const Command& command) {
    switch (command.kind) {
        case CommandKind::Hold:
        case CommandKind::Stop:
        case CommandKind::EmergencyStop: return false;
        case CommandKind::Jog: return !command.jogs.empty();
        default: return true;
    }
}

/// TakeLease or GiveLease.
constexpr bool is_about_lease(CommandKind kind) {
    return kind == CommandKind::TakeLease || kind == CommandKind::GiveLease;
}

}  // namespace lockstep
