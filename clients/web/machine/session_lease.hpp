// The writer's lease of a server's session.
#pragma once

#include <optional>
#include <string>

#include "clients/session/session.hpp"
#include "clients/web/machine/writer_turn.hpp"
#include "clients/web/request/problem.hpp"
#include "clients/web/state/snapshot.hpp"

namespace lockstep::web {

class SessionLease {
public:
    /// `name`: the writer's, for people.
    SessionLease(Session& session, const std::string& name);

    /// In each loop, behind what the session has received.
    void pass(const WriterTurn::Use& use, nanoseconds now);
    void give() { turn_.give(); }
    /// At the end: waits a moment for the coordinator's answer.
    void end();

    bool is_held() const { return turn_.is_held(); }
    /// Of a command that waits for the lease; nothing: it waits on.
    std::optional<Problem> refusal(bool takes_over) const;
    /// The machine's writer. Nothing: it has none.
    const std::optional<Writer>& writer() const { return writer_; }

private:
    void note_writer();

    Session& session_;
    WriterTurn turn_;
    std::optional<HeldLease> seen_;
    std::optional<Writer> writer_;  // of seen_
};

}  // namespace lockstep::web
