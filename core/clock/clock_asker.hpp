// An axis's side of an exchange: decides when to ask, and matches replies to requests.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/clock/clock_estimator.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class ClockAsker {
public:
    /// The time between two requests. Several fall into each stretch of time of which the estimator keeps the best
    /// exchange.
    static constexpr double kPeriod_s = 0.05;

    ClockAsker(std::uint32_t axis, Identity identity, std::int64_t tick_ns)
        : axis_(axis), identity_(identity), period_{static_cast<std::int64_t>(kPeriod_s * 1e9) / tick_ns} {}

    /// The request to send when the own clock reads `own`, if one is due.
    std::optional<ClockRequest> ask(Tick own);

    /// Returns the exchange that this reply completes, or nullopt if it answers no open request of this axis.
    std::optional<ClockExchange> receive(const ClockReply& reply, Tick own);

private:
    static constexpr std::size_t kOpen = 16;  // the asker gives up older requests

    std::uint32_t axis_;
    Identity identity_;
    Ticks period_;
    std::uint64_t sequence_ = 0;
    std::optional<Tick> asked_;
    std::deque<ClockRequest> open_;
};

}  // namespace lockstep
