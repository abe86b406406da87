// The writer's lease: one writer at a time gives commands that move the machine or change it. The others watch. Every
// client may hold and stop. While there is no writer, every client may give all commands.
#pragma once

#include <optional>
#include <vector>

#include "core/coordinator/state/refusal.hpp"
#include "core/machine.hpp"
#include "core/protocol/client_memory.hpp"
#include "core/protocol/lease_holder.hpp"

namespace lockstep {

class WriterLease {
public:
    explicit WriterLease(const MachineConfig& machine);

    /// Handles a TakeLease, also when it is repeated: begins the lease, joins its writer's clients, or keeps it. When
    /// another writer has taken the lease over, a client's old request no longer keeps it. Only a new request can get
    /// it.
    CommandResult take(const Command& command, Tick now, Slot slot);
    /// The lease ends with the last of its writer's clients.
    void give(Identity client);
    /// Whether its client may give the command: no other writer holds the lease, or the command only makes the machine
    /// safer.
    CommandResult check(const Command& command, Tick now) const;
    /// Whether this writer may send programs.
    CommandResult check(std::uint64_t writer, Tick now) const;
    /// Call it once a slot. Removes clients that are silent for kLeaseSilence_ms. `missed`: slots before this one in
    /// which this process was stalled. Returns the removed clients, valid until the next call.
    const std::vector<Identity>& tend(Slot slot, Slot missed);
    /// Adopts the lease of the last owner after a takeover. It continues if its writer keeps it.
    void adopt(const std::optional<HeldLease>& lease, Slot slot);
    void drop() { adopt({}, 0); }

    const std::optional<HeldLease>& held() const { return held_; }
    /// LeaseHolder::id of the writer.
    std::optional<std::uint64_t> writer() const { return held_ ? std::optional(held_->writer.id) : std::nullopt; }

private:
    struct Member {
        std::optional<Identity> client;  // nullopt: not received yet, after a takeover
        Slot received = 0;
        std::uint64_t sequence = 0;  // of the client's request
    };
    /// A client that has lost the lease to another writer.
    struct Loser {
        std::uint64_t sequence = 0;  // of the client's last request
        std::string text;            // says which writer has taken the machine over
    };
    static constexpr std::size_t kMostMembers = ClientMemory<Loser>::kClients;

    CommandResult check_loser(const Command& command) const;
    void pass_to(const LeaseHolder& writer, Tick now);
    void note(const Command& command, Slot slot);
    std::string text_of(const HeldLease& lease, Tick now) const;

    double ticks_per_second_;
    Slot silence_;
    std::optional<HeldLease> held_;
    ClientMemory<Loser> losers_;
    std::vector<Identity> silent_;  // removed in the last tend()
    std::vector<Member> members_;   // the writer's clients, the one received longest ago first
};

}  // namespace lockstep
