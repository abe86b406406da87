#include "clients/session/control/jog_link.hpp"

#include <algorithm>

#include "services/runtime/clock.hpp"

namespace lockstep {

void JogLink::press(const std::vector<JogAxis>& jogs) {
    if (jogs == command_.jogs) { return; }
    command_.jogs = jogs;
    session_.begin(command_);
    renewed_ = monotonic_now();
}

/// A release is repeated too, until it is answered.
void JogLink::pass(std::chrono::nanoseconds until) {
    for (auto now = monotonic_now(); now < until; now = monotonic_now()) {
        const bool is_due = now >= renewed_ + kPeriod && command_.sequence != 0;
        if (is_due && (is_pressed() || reply() == nullptr)) { session_.repeat(command_); }
        if (is_due) { renewed_ = now; }
        session_.receive(std::min(until, renewed_ + kPeriod) - now);
    }
}

bool JogLink::is_over() const {
    const Reply* newest = reply();
    return newest != nullptr && newest->status == ReplyStatus::Accepted && newest->job == 0;
}

}  // namespace lockstep
