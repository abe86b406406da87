// The lease for as long as one command of a person lasts: taken at its begin, given back at its end.
#pragma once

#include <expected>

#include "clients/session/session.hpp"

namespace lockstep {

class LeaseTurn {
public:
    /// As the login's writer. `takes_over`: from another writer, too.
    LeaseTurn(Session& session, bool takes_over, const StopSignal* stop = nullptr);
    LeaseTurn(const LeaseTurn&) = delete;
    LeaseTurn& operator=(const LeaseTurn&) = delete;
    /// Waits a moment for the coordinator's answer: a process that has ended sends nothing more.
    ~LeaseTurn();

    /// Refused where another writer has it. Error: no answer.
    const std::expected<Reply, Failure>& answer() const { return answer_; }
    bool is_refused() const { return answer_ && answer_->status == ReplyStatus::Refused; }

private:
    Session& session_;
    std::expected<Reply, Failure> answer_;
};

}  // namespace lockstep
