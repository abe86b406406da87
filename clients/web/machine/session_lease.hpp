// The writer's lease of a server's session.
#pragma once

#include <optional>
#include <string>

#include "clients/session/session.hpp"
#include "clients/session/waits.hpp"
#include "clients/web/request/problem.hpp"
#include "clients/web/state/snapshot.hpp"

namespace lockstep::web {

class SessionLease {
public:
    /// `name`: the writer's name, as people see it.
    SessionLease(Session& session, const std::string& name);

    /// Notes the machine's writer. Call it when the session has received messages.
    void see();
    /// Call it in each loop, after the commands that wait for the lease have looked at is_held() and refusal().
    void use(const LeaseUse& use) { use_lease(session_, use); }
    void give() { give_lease(session_); }
    /// Gives the lease back and waits briefly for the coordinator's answer. Call it at the end.
    void end() { give_lease(session_, kGivePatience); }

    bool is_held() const { return session_.lease().is_held(); }
    /// Why a command that waits for the lease has failed: another writer has the lease, or the coordinator does not
    /// answer. Nullopt while the command must wait on.
    std::optional<Problem> refusal(bool takes_over) const;
    /// The machine's writer; nullopt if it has none.
    const std::optional<Writer>& writer() const { return writer_; }

private:
    Session& session_;
    std::optional<HeldLease> seen_;
    std::optional<Writer> writer_;  // of seen_
};

/// Why a command has no answer.
std::string silence_of(const Session& session);

}  // namespace lockstep::web
