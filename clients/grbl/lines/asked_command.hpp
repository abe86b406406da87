// A command that is sent again until its reply comes.
#pragma once

#include <chrono>
#include <utility>

#include "clients/grbl/lines/machine_port.hpp"

namespace lockstep::grbl {

class AskedCommand {
public:
    AskedCommand(Command command, MachinePort& port, std::chrono::nanoseconds now)
        : command_(std::move(command)), sent_(now) {
        port.begin(command_);
        repeated_ = now;
    }

    /// Returns null while no reply has come.
    const Reply* reply(MachinePort& port, std::chrono::nanoseconds now) {
        const Reply* reply = port.reply_to(command_);
        if (reply == nullptr && now - repeated_ >= kRepeatAfter) {
            port.repeat(command_);
            repeated_ = now;
        }
        return reply;
    }
    bool is_overdue(std::chrono::nanoseconds now) const { return now - sent_ > kPatience; }

    static constexpr std::chrono::milliseconds kRepeatAfter{250};
    static constexpr std::chrono::seconds kPatience{10};  // enough for a standby to take over

private:
    Command command_;
    std::chrono::nanoseconds sent_;
    std::chrono::nanoseconds repeated_{};
};

}  // namespace lockstep::grbl
