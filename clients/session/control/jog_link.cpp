#include "clients/session/control/jog_link.hpp"

#include "services/runtime/clock.hpp"

namespace lockstep {

void JogLink::press(const std::vector<JogAxis>& jogs) {
    if (jogs == command_.jogs) { return; }
    command_.jogs = jogs;
    session_.begin(command_);
    repeat_.note_sent(monotonic_now());
}

/// A release is repeated too, until it is answered.
bool JogLink::is_repeated() const { return is_pressed() || (command_.sequence != 0 && reply() == nullptr); }

void JogLink::pass(std::chrono::nanoseconds until) {
    for (auto now = monotonic_now(); now < until; now = monotonic_now()) {
        if (repeat_.is_due(is_repeated(), now)) {
            session_.repeat(command_);
            repeat_.note_sent(now);
        }
        session_.receive(repeat_.wake(is_repeated(), until) - now);
    }
}

bool JogLink::is_over() const {
    const Reply* newest = reply();
    return newest != nullptr && newest->status == ReplyStatus::Accepted && newest->job == 0;
}

}  // namespace lockstep
