#include "clients/session/control/jog_link.hpp"

#include "services/runtime/clock.hpp"

namespace lockstep {

void JogLink::press(const std::vector<JogAxis>& jogs) {
    if (jogs == command_.jogs) { return; }
    command_.jogs = jogs;
    is_begun_ = false;
    send(monotonic_now());
}

/// A client that was itself stopped first looks what the machine does.
void JogLink::send(std::chrono::nanoseconds now) {
    repeat_.note_sent(now);
    if (is_pressed() && !session_.sight().is_current) { return; }
    is_begun_ ? session_.repeat(command_) : session_.begin(command_);
    is_begun_ = true;
}

/// A release is repeated too, until it is answered.
bool JogLink::is_repeated() const { return is_pressed() || (is_begun_ && reply() == nullptr); }

void JogLink::pass(std::chrono::nanoseconds until) {
    for (auto now = monotonic_now(); now < until; now = monotonic_now()) {
        if (repeat_.is_due(is_repeated(), now)) { send(now); }
        session_.receive(repeat_.wake(is_repeated(), until) - now);
    }
}

bool JogLink::is_over() const {
    const Reply* newest = reply();
    return newest != nullptr && newest->status == ReplyStatus::Accepted && newest->job == 0;
}

}  // namespace lockstep
