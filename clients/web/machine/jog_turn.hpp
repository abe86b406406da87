// The jogs of a server: one client at a time, and only with the machine's lease.
#pragma once

#include <vector>

#include "clients/session/control/jog_link.hpp"
#include "clients/web/machine/jog_guard.hpp"
#include "clients/web/machine/session_lease.hpp"

namespace lockstep::web {

class JogTurn {
public:
    explicit JogTurn(Session& session) : link_(session) {}

    void take(const JogOrder& order, const Done& done, nanoseconds now);
    /// A jog that named this event stream ends with it.
    void end_stream(const std::string& name);
    /// Receives messages until `until`, and renews the jog meanwhile.
    void pass(nanoseconds until) { link_.pass(until); }
    /// Begins a jog that waited for the lease, answers renewals that the coordinator has answered, and ends a jog that
    /// is not renewed.
    void follow(const SessionLease& lease, nanoseconds now);
    void release() { link_.release(); }

    bool is_pressed() const { return guard_.is_pressed(); }

private:
    void end(const Problem& problem);
    void answer(const Outcome& outcome);

    JogLink link_;
    JogGuard guard_;
    std::vector<JogAxis> jogs_;  // while it is pressed
    std::vector<Done> waiting_;  // for the coordinator's answer to the jog
};

}  // namespace lockstep::web
