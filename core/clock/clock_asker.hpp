// An axis's side of an exchange: when to ask, and which reply answers what.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/clock/clock_estimator.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class ClockAsker {
public:
    /// Between two requests: a few in each stretch of time of which the estimator keeps the best.
    static constexpr double kPeriod_s = 0.05;

    ClockAsker(std::uint32_t axis, Identity identity, std::int64_t tick_ns)
        : axis_(axis), identity_(identity), period_{static_cast<std::int64_t>(kPeriod_s * 1e9) / tick_ns} {}

    /// The request to send when the own clock reads `own`, if one is due.
    std::optional<ClockRequest> ask(Tick own);

    /// The exchange that this reply ends. None: it answers no open request of this axis.
    std::optional<ClockExchange> receive(const ClockReply& reply, Tick own);

private:
    static constexpr std::size_t kOpen = 16;  // older requests will not be answered

    std::uint32_t axis_;
    Identity identity_;
    Ticks period_;
    std::uint64_t sequence_ = 0;
    std::optional<Tick> asked_;
    std::deque<ClockRequest> open_;
};

}  // namespace lockstep
