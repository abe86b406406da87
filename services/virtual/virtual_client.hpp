// A client of a virtual machine. It numbers its commands, and keeps the newest states and all replies.
#pragma once

#include <optional>
#include <vector>

#include "core/machine.hpp"
#include "services/virtual/mail.hpp"

namespace lockstep {

class VirtualClient {
public:
    explicit VirtualClient(const MachineConfig& machine);

    /// Returns the command with the client's identity and the next sequence number.
    const Command& ask(Command command);
    /// Returns the part with the client's identity and the next sequence number.
    ProgramPart address(ProgramPart part);
    const Command& last_command() const { return command_; }

    void receive(Mail& mail, Tick now);

    /// The machine's newest state, from its owner; nullopt before the first.
    const std::optional<MachineState>& state() const { return machine_; }
    const std::vector<std::optional<AxisState>>& axis_states() const { return axes_; }
    const std::vector<Reply>& replies() const { return replies_; }
    /// Null if no reply has come yet.
    const Reply* reply_to(std::uint64_t sequence) const;
    /// Removes the reply, to free its memory.
    void forget_reply(std::uint64_t sequence);

private:
    void receive(const AxisState& state);
    void receive(const MachineState& state, Tick now);

    static constexpr Identity kIdentity = 1;

    Ticks silence_;  // after it, a state of an owner with a lower term is accepted
    std::uint64_t sequence_ = 0;
    Command command_{.client = kIdentity};
    std::vector<Reply> replies_;
    std::optional<MachineState> machine_;
    Tick received_;  // true time at which machine_ was received
    std::vector<std::optional<AxisState>> axes_;
};

}  // namespace lockstep
