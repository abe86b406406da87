// The messages of a client that runs programs, over DDS or, in tests, to a machine in virtual time.
#pragma once

#include <optional>

#include "clients/session/follow/command_tracker.hpp"
#include "clients/session/upload/program_sender.hpp"
#include "core/program.hpp"

namespace lockstep::grbl {

class MachinePort {
public:
    virtual ~MachinePort() = default;
    /// Begins to send a program, and forgets the previous one. The sender is valid until the next open() or close().
    virtual ProgramSender& open(const ProgramHead& head) = 0;
    /// Sends no more of the program. Its sender is no longer valid.
    virtual void close() = 0;
    /// See ProgramUpload::is_overdue.
    virtual bool is_overdue() = 0;
    /// Call in each loop until the command is over. Sends the command when that is due.
    virtual CommandStep follow(CommandTracker& tracker) = 0;
};

/// Follows the command, if there is one, and forgets it when it is over.
inline void follow(MachinePort& port, std::optional<CommandTracker>& tracker) {
    if (tracker && is_over(port.follow(*tracker))) { tracker.reset(); }
}

inline void begin(MachinePort& port, std::optional<CommandTracker>& tracker, CommandKind kind) {
    tracker.emplace(Command{.kind = kind});
    follow(port, tracker);
}

}  // namespace lockstep::grbl
