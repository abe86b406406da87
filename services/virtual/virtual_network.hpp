// Carries messages in virtual time, one copy per receiver. Delays, reorders, duplicates, loses and alters them at
// random, by a seed.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <variant>
#include <vector>

#include "services/virtual/corruption.hpp"

namespace lockstep {

/// How the network treats messages. Each copy has a delay of uniform distribution, so a later message may overtake an
/// earlier one.
struct NetworkBehaviour {
    Ticks delay_min{50};
    Ticks delay_max{50};
    double duplicated = 0;  // probability
    double lost = 0;        // probability
    double corrupted = 0;   // probability
    Ticks reply_longer{};   // how much longer a clock reply takes than its request
};

/// One message, shared by all its copies.
using SharedMessage = std::shared_ptr<const VirtualMessage>;

class VirtualNetwork {
public:
    using Address = std::uint32_t;

    VirtualNetwork(const NetworkBehaviour& behaviour, std::uint64_t seed) : behaviour_(behaviour), random_(seed) {}

    void send(Tick now, Address from, Address to, SharedMessage message);

    /// Calls take(message) for the messages that have arrived at `to` by `now`, oldest arrival first.
    template <typename Take>
    void receive(Tick now, Address to, Take&& take) {
        while (next_arrival(to) <= now) {
            std::visit(take, *mailboxes_[to].front().message);
            mailboxes_[to].pop_front();
        }
    }

    /// When the next message arrives there; kNever if none is in transit.
    Tick next_arrival(Address to) const {
        return to < mailboxes_.size() && !mailboxes_[to].empty() ? mailboxes_[to].front().arrives : kNever;
    }
    static constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};

    /// A link may be cut several times. It carries messages again after the same number of restores.
    void cut(Address from, Address to) { ++cuts_[{from, to}]; }
    void restore(Address from, Address to) { --cuts_[{from, to}]; }

    /// Messages to this address are never altered.
    void trust(Address to) { trusted_ = to; }
    /// How many messages have been altered in each way.
    const AlterationCounts& alterations() const { return alterations_; }

private:
    struct Parcel {
        Tick arrives;
        SharedMessage message;
    };
    using Mailbox = std::deque<Parcel>;  // in order of arrival; overtaking is rare

    bool happens(double probability);
    bool is_cut(Address from, Address to) const;
    SharedMessage altered(const SharedMessage& message);
    void post(Tick now, Address to, SharedMessage message);

    NetworkBehaviour behaviour_;
    std::mt19937_64 random_;
    std::map<std::pair<Address, Address>, int> cuts_;
    std::optional<Address> trusted_;
    AlterationCounts alterations_{};
    std::vector<Mailbox> mailboxes_;
};

}  // namespace lockstep
