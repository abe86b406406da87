// Which of two processes of the same part stays, for example where one axis was started on two hosts.
//
// The one that is in the machine stays: its states were received by the other soon after that one began, while it had
// run alone for long. Clocks of different hosts are not compared: each process measures on its own clock how long it
// had run when the first state of the other came. Neither knows what the other measured, so each leaves after a time
// that depends on what it knows itself, and only while the other still publishes: the one that should leave does so
// first, and the other then has nobody to leave for.
#pragma once

#include <optional>

#include "core/units.hpp"

namespace lockstep {

class Rival {
public:
    /// `self`: this process's identity. It began to publish at `begun`, by its own clock.
    Rival(std::uint64_t self, std::int64_t tick_ns, Tick begun)
        : self_(self), second_{1'000'000'000 / tick_ns}, begun_(begun) {}

    /// A state of the other process was received; `proved`: enough of them came to prove that it lives. True: this
    /// process must leave.
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
    /// How soon DDS finds a process that is there.
    static constexpr std::int64_t kDiscovery_s = 5;
    static constexpr std::int64_t kTurn_s = 3;

    /// None: it stays. Started together, or joined after a cut, the lower identity stays: an order, not an age.
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
    Tick first_;                  // when its first state came
    std::optional<Tick> proved_;  // since when it is known to live
};

}  // namespace lockstep
