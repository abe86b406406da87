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
    /// `name`: the writer's name, as people see it.
    SessionLease(Session& session, const std::string& name);

    /// Call it in each loop, after the session has received messages.
    void pass(const WriterTurn::Use& use, nanoseconds now);
    void give() { turn_.give(); }
    /// Gives the lease back and waits briefly for the coordinator's answer. Call it at the end.
    void end();

    bool is_held() const { return turn_.is_held(); }
    /// The refusal of a command that waits for the lease; nullopt while the command must wait on.
    std::optional<Problem> refusal(bool takes_over) const;
    /// The machine's writer; nullopt if it has none.
    const std::optional<Writer>& writer() const { return writer_; }

private:
    void note_writer();

    Session& session_;
    WriterTurn turn_;
    std::optional<HeldLease> seen_;
    std::optional<Writer> writer_;  // of seen_
};

}  // namespace lockstep::web
