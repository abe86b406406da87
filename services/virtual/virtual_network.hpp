// Messages in virtual time: delayed, reordered and duplicated as a seed says, one copy per receiver.
#pragma once

#include <cstdint>
#include <memory>
#include <queue>
#include <random>
#include <variant>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep {

/// How messages travel. A delay is drawn evenly for each copy, so that later ones may overtake earlier ones.
struct NetworkBehaviour {
    Ticks delay_min{50};
    Ticks delay_max{50};
    double duplicated = 0;  // probability
    double lost = 0;        // probability
};

using VirtualMessage = std::variant<Frame, AxisState, MachineState, AxisCommand, Command, Reply>;

/// One message, however many copies of it are on their way.
using SharedMessage = std::shared_ptr<const VirtualMessage>;

class VirtualNetwork {
public:
    using Receiver = std::uint32_t;

    VirtualNetwork(const NetworkBehaviour& behaviour, std::uint64_t seed) : behaviour_(behaviour), random_(seed) {}

    void send(Tick now, Receiver to, SharedMessage message);

    /// The next message that has arrived at `to` by `now`, oldest arrival first. Null: no more.
    SharedMessage receive(Tick now, Receiver to);

private:
    struct Parcel {
        Tick arrives;
        std::uint64_t number = 0;
        SharedMessage message;
        bool operator>(const Parcel& other) const {
            return arrives != other.arrives ? arrives > other.arrives : number > other.number;
        }
    };
    using Mailbox = std::priority_queue<Parcel, std::vector<Parcel>, std::greater<>>;

    bool happens(double probability);
    void post(Tick now, Receiver to, SharedMessage message);

    NetworkBehaviour behaviour_;
    std::mt19937_64 random_;
    std::vector<Mailbox> mailboxes_;
    std::uint64_t sent_ = 0;
};

}  // namespace lockstep
