// The messages of a client that runs programs: over DDS, and in tests to a machine in virtual time.
#pragma once

#include "clients/session/program_sender.hpp"
#include "core/program.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::grbl {

class MachinePort {
public:
    virtual ~MachinePort() = default;
    /// Begins to send a program, and forgets the one before. Valid until the next one.
    virtual ProgramSender& open(const ProgramHead& head) = 0;
    /// No more is sent of the program, and its sender is valid no more.
    virtual void close() = 0;
    /// Gives the command a number of its own and sends it.
    virtual void begin(Command& command) = 0;
    virtual void repeat(const Command& command) = 0;
    /// Null: none has come yet.
    virtual const Reply* reply_to(const Command& command) = 0;
};

}  // namespace lockstep::grbl
