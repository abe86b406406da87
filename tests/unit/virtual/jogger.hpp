// A client that jogs the axes of a virtual machine: it repeats its command every 5 ms while it holds the keys.
#pragma once

#include <vector>

#include "services/virtual/virtual_machine.hpp"

namespace lockstep {

class Jogger {
public:
    static constexpr Ticks kPeriod{5'000};

    explicit Jogger(VirtualMachine& vm, Identity client = 50)
        : vm_(vm), command_{.client = client, .sequence = client * 1'000'000} {}

    /// Jogs these axes and no others from now on. Returns the command's sequence number.
    std::uint64_t press(std::vector<JogAxis> jogs) {
        command_.kind = CommandKind::Jog;
        ++command_.sequence;
        command_.jogs = std::move(jogs);
        is_alive_ = true;
        renew();
        return command_.sequence;
    }
    void release() { press({}); }
    void write_as(std::uint64_t writer) { command_.writer.id = writer; }
    /// The client sends nothing more.
    void die() { is_alive_ = false; }
    bool is_alive() const { return is_alive_; }

    void renew() {
        if (is_alive_) { vm_.send(command_); }
        renewed_ = vm_.now();
    }
    /// When the next renewal is due.
    Tick due() const { return renewed_ + kPeriod; }

    const Reply* reply() const {
        for (auto reply = vm_.replies().rbegin(); reply != vm_.replies().rend(); ++reply) {
            if (reply->client == command_.client && reply->sequence == command_.sequence) { return &*reply; }
        }
        return nullptr;
    }

private:
    VirtualMachine& vm_;
    Command command_;
    Tick renewed_;
    bool is_alive_ = false;
};

/// Runs the machine for `time` while the clients renew their jogs.
inline void pass(VirtualMachine& vm, const std::vector<Jogger*>& joggers, Ticks time) {
    for (const Tick end = vm.now() + time; vm.now() < end;) {
        Tick next = end;
        for (Jogger* jogger : joggers) {
            if (jogger->due() <= vm.now()) { jogger->renew(); }
            next = std::min(next, jogger->due());
        }
        (void)vm.advance_until([] { return false; }, std::max(next - vm.now(), Ticks{1}));
    }
}

}  // namespace lockstep
