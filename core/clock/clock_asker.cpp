#include "core/clock/clock_asker.hpp"

#include <algorithm>

namespace lockstep {

std::optional<ClockRequest> ClockAsker::ask(Tick own) {
    const bool was_set_back = asked_ && own < *asked_;
    if (asked_ && !was_set_back && own - *asked_ < period_) { return std::nullopt; }
    asked_ = own;
    open_.push_back({.axis = axis_, .identity = identity_, .sequence = ++sequence_, .sent = own});
    if (open_.size() > kOpen) { open_.pop_front(); }
    return open_.back();
}

std::optional<ClockExchange> ClockAsker::receive(const ClockReply& reply, Tick own) {
    const auto asked = std::ranges::find(open_, reply.request);
    if (asked == open_.end()) { return std::nullopt; }
    open_.erase(asked);  // a later copy of the reply would only prove less
    return ClockExchange{reply.request.sent, reply.received, reply.answered, own};
}

}  // namespace lockstep
