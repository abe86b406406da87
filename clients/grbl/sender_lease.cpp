#include "clients/grbl/sender_lease.hpp"

#include <utility>

namespace lockstep::grbl {

std::optional<Reply> SenderLease::claim(std::chrono::nanoseconds now) {
    worked_ = now;
    if (session_.holds_lease() || session_.is_silent()) { return std::nullopt; }
    const auto reply = session_.take_lease(takes_over_);
    is_held_ = session_.holds_lease();
    return reply && !is_held_ ? std::optional(*reply) : std::nullopt;
}

std::optional<std::string> SenderLease::pass(bool has_work, std::chrono::nanoseconds now) {
    if (has_work) { worked_ = now; }
    const bool was_held = std::exchange(is_held_, session_.holds_lease());
    if (was_held && !is_held_) { return session_.lease_reply() ? session_.lease_reply()->text : "the lease is lost"; }
    if (is_held_ && now - worked_ > kGiveLeaseAfter) {
        session_.give_lease();
        is_held_ = false;
    }
    return std::nullopt;
}

}  // namespace lockstep::grbl
