// Decides which of two processes with the same role stays, for example if one axis was started on two hosts.
//
// The process that was in the machine first stays. A newcomer receives the other's states soon after its own start; the
// first process has run alone for longer by then. Clocks of different hosts are not compared. Each process measures on
// its own clock how long it had run when the other's first state arrived. Neither knows what the other measured. So
// each leaves after a time that depends only on its own measurement, and only while the other still publishes. The one
// that should leave does so first, and the other then has no reason to leave.
#pragma once

#include <optional>

#include "core/units.hpp"

namespace lockstep {

class Rival {
public:
    /// `self`: this process's identity. `begun`: when it began to publish, by its own clock.
    Rival(std::uint64_t self, std::int64_t tick_ns, Tick begun)
        : self_(self), second_{1'000'000'000 / tick_ns}, begun_(begun) {}

    /// Takes a received state of the other process. `proved`: enough states came to prove that it runs. Returns true if
    /// this process must leave.
    bool must_leave(std::uint64_t other, bool proved, Tick now) {
        if (other != other_) {
            other_ = other;
            first_ = now;
            proved_.reset();
        }
        if (!proved) { return false; }
        proved_ = proved_.value_or(now);
        const auto patience = patience_for(other);
        return patience && now - *proved_ >= *patience;
    }

private:
    /// DDS finds a running process within this time.
    static constexpr std::int64_t kDiscovery_s = 5;
    static constexpr std::int64_t kTurn_s = 3;

    /// Returns nullopt if this process stays. If both started together, or met after a cut, the one with the lower
    /// identity stays. Identities are only an order here, not an age.
    std::optional<Ticks> patience_for(std::uint64_t other) const {
        const bool is_new = first_ - begun_ < second_ * kDiscovery_s;
        const bool gives_way = other < self_;
        if (is_new) { return gives_way ? Ticks{} : second_ * kTurn_s; }
        return gives_way ? std::optional(second_ * (2 * kTurn_s)) : std::nullopt;
    }

    std::uint64_t self_;
    Ticks second_;
    Tick begun_;
    std::uint64_t other_ = 0;
    Tick first_;                  // when the other's first state came
    std::optional<Tick> proved_;  // since when the other is known to run
};

}  // namespace lockstep
