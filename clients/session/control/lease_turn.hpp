// Holds the lease for one command of a person: takes it at the begin and gives it back at the end.
#pragma once

#include <expected>

#include "clients/session/session.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {

class LeaseTurn {
public:
    /// Takes the lease as the login's writer. `takes_over` takes it from another writer, too.
    LeaseTurn(Session& session, bool takes_over, const StopSignal* stop = nullptr);
    LeaseTurn(const LeaseTurn&) = delete;
    LeaseTurn& operator=(const LeaseTurn&) = delete;
    /// Waits briefly for the coordinator's answer, because a process that has ended sends nothing more.
    ~LeaseTurn();

    /// The reply, which is a refusal if another writer has the lease. The error means that no reply came.
    const std::expected<Reply, Failure>& answer() const { return answer_; }
    bool is_refused() const { return answer_ && answer_->status == ReplyStatus::Refused; }

private:
    Session& session_;
    std::expected<Reply, Failure> answer_;
};

}  // namespace lockstep
