#include "clients/session/control/jog_link.hpp"

#include <algorithm>

#include "services/runtime/clock.hpp"

namespace lockstep {

void JogLink::press(const std::vector<JogAxis>& jogs) {
    const bool is_current = tracker_ ? jogs == tracker_->command().jogs : jogs.empty();
    if (is_current) { return; }
    tracker_.emplace(Command{.kind = CommandKind::Jog, .jogs = jogs});
    step_ = session_.follow(*tracker_);
}

void JogLink::pass(std::chrono::nanoseconds until) {
    for (auto now = monotonic_now(); now < until; now = monotonic_now()) {
        if (tracker_) { step_ = session_.follow(*tracker_); }
        const auto due_in = tracker_ ? tracker_->due_in(session_.owner().running_time()) : std::nullopt;
        session_.receive(std::min(until - now, due_in ? std::max(*due_in, kLeastWait) : until - now));
    }
}

const Reply* JogLink::reply() const { return tracker_ && tracker_->reply() ? &*tracker_->reply() : nullptr; }

bool JogLink::is_over() const {
    const Reply* newest = reply();
    return newest != nullptr && newest->status == ReplyStatus::Accepted && newest->job == 0;
}

}  // namespace lockstep
