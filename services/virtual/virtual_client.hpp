// A client of a virtual machine: its commands, and the newest states and all replies that it has received.
#pragma once

#include <optional>
#include <vector>

#include "core/machine.hpp"
#include "services/virtual/mail.hpp"

namespace lockstep {

class VirtualClient {
public:
    explicit VirtualClient(const MachineConfig& machine);

    /// The next command, with a sequence number of its own.
    const Command& ask(Command command);
    /// From this client, with a sequence number of its own.
    ProgramPart address(ProgramPart part);
    const Command& last_command() const { return command_; }

    void receive(Mail& mail, Tick now);

    /// Of the machine, from its owner; nothing before the first.
    const std::optional<MachineState>& state() const { return machine_; }
    const std::vector<std::optional<AxisState>>& axis_states() const { return axes_; }
    const std::vector<Reply>& replies() const { return replies_; }
    /// Null: none has come yet.
    const Reply* reply_to(std::uint64_t sequence) const;
    /// Frees its memory.
    void forget_reply(std::uint64_t sequence);

private:
    void receive(const AxisState& state);
    void receive(const MachineState& state, Tick now);

    static constexpr Identity kIdentity = 1;

    Ticks silence_;  // after which an owner of a lower term counts
    std::uint64_t sequence_ = 0;
    Command command_{.client = kIdentity};
    std::vector<Reply> replies_;
    std::optional<MachineState> machine_;
    Tick received_;  // the newest state of the machine: the true time
    std::vector<std::optional<AxisState>> axes_;
};

}  // namespace lockstep
