// Messages in virtual time: delayed, reordered, duplicated, lost and altered as a seed says, one copy per receiver.
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

/// How messages travel. A delay is drawn evenly for each copy, so that later ones may overtake earlier ones.
struct NetworkBehaviour {
    Ticks delay_min{50};
    Ticks delay_max{50};
    double duplicated = 0;  // probability
    double lost = 0;        // probability
    double corrupted = 0;   // probability
    Ticks reply_longer{};   // than its request an answer to what time it is takes
};

/// One message, however many copies of it are on their way.
using SharedMessage = std::shared_ptr<const VirtualMessage>;

class VirtualNetwork {
public:
    using Address = std::uint32_t;

    VirtualNetwork(const NetworkBehaviour& behaviour, std::uint64_t seed) : behaviour_(behaviour), random_(seed) {}

    void send(Tick now, Address from, Address to, SharedMessage message);

    /// Hands what has arrived at `to` by `now` to `take`, oldest arrival first.
    template <typename Take>
    void receive(Tick now, Address to, Take&& take) {
        while (next_arrival(to) <= now) {
            std::visit(take, *mailboxes_[to].front().message);
            mailboxes_[to].pop_front();
        }
    }

    /// When the next message arrives there; kNever: none is on its way.
    Tick next_arrival(Address to) const {
        return to < mailboxes_.size() && !mailboxes_[to].empty() ? mailboxes_[to].front().arrives : kNever;
    }
    static constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};

    /// A link may be cut several times over; it carries messages again when it was restored as often.
    void cut(Address from, Address to) { ++cuts_[{from, to}]; }
    void restore(Address from, Address to) { --cuts_[{from, to}]; }

    /// Messages to this one are never altered.
    void trust(Address to) { trusted_ = to; }
    /// How many messages have been altered in each way.
    const AlterationCounts& alterations() const { return alterations_; }

private:
    struct Parcel {
        Tick arrives;
        SharedMessage message;
    };
    using Mailbox = std::deque<Parcel>;  // in order of arrival; few ever overtake others

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
