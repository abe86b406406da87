// The messages of a client that runs programs, over DDS or, in tests, to a machine in virtual time.
#pragma once

#include "clients/session/program_sender.hpp"
#include "core/program.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::grbl {

class MachinePort {
public:
    virtual ~MachinePort() = default;
    /// Begins to send a program, and forgets the previous one. The sender is valid until the next open() or close().
    virtual ProgramSender& open(const ProgramHead& head) = 0;
    /// Sends no more of the program. Its sender is no longer valid.
    virtual void close() = 0;
    /// Gives the command a new number and sends it.
    virtual void begin(Command& command) = 0;
    virtual void repeat(const Command& command) = 0;
    /// Returns null while no reply has come.
    virtual const Reply* reply_to(const Command& command) = 0;
};

}  // namespace lockstep::grbl
