#include "clients/web/machine/jog_turn.hpp"

#include <utility>

namespace lockstep::web {

void JogTurn::take(const JogOrder& order, const Done& done, nanoseconds now) {
    const auto taken = guard_.take(order, now);
    if (!taken) { return done(std::unexpected(taken.error())); }
    if (*taken == JogGuard::Press::Released) {
        if (!guard_.is_pressed()) { link_.release(); }
        return done(Accepted{.jogging = false});
    }
    // JogLink ignores a press of the same axes until they are released.
    if (*taken == JogGuard::Press::New && link_.is_over()) { link_.release(); }
    if (!guard_.is_step() || *taken == JogGuard::Press::New) { jogs_ = order.jogs; }
    waiting_.push_back(done);
}

void JogTurn::end_stream(const std::string& name) {
    if (guard_.end_stream(name)) { link_.release(); }
}

void JogTurn::follow(const SessionLease& lease, nanoseconds now) {
    if (guard_.runs_out(now)) { link_.release(); }
    if (guard_.is_pressed()) {
        if (const auto refusal = lease.refusal(false)) { return end(*refusal); }
        if (lease.is_held()) { link_.press(jogs_); }
        if (!link_.is_pressed()) { return; }  // the jog waits for the lease
    }
    const Reply* reply = link_.reply();
    if (link_.is_pressed() && reply == nullptr) { return; }
    if (link_.is_pressed() && reply->status == ReplyStatus::Refused) { return end(refused(reply->fault, reply->text)); }
    if (guard_.is_step() && link_.is_over()) { guard_.complete(now); }
    answer(Accepted{.jogging = link_.is_pressed() && !link_.is_over()});
}

void JogTurn::end(const Problem& problem) {
    answer(std::unexpected(problem));
    guard_.end();
    link_.release();
}

void JogTurn::answer(const Outcome& outcome) {
    for (const Done& done : std::exchange(waiting_, {})) { done(Outcome(outcome)); }
}

}  // namespace lockstep::web
