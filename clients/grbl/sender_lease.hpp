// The writer's lease of a sender: taken with its first work, given back when it has had none for a while.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "clients/session/session.hpp"

namespace lockstep::grbl {

class SenderLease {
public:
    /// `takes_over`: from another writer, too.
    SenderLease(Session& session, bool takes_over) : session_(session), takes_over_(takes_over) {}

    /// Before work is begun; waits for the coordinator's answer where it must ask for the lease. Returns the refusal:
    /// another writer has it; nothing: there is none, or the coordinator is silent and refuses nothing.
    std::optional<Reply> claim(std::chrono::nanoseconds now);
    /// In each loop. Returns who has taken the machine over, once: nobody did.
    std::optional<std::string> pass(bool has_work, std::chrono::nanoseconds now);
    void give() { session_.give_lease(); }

    static constexpr std::chrono::seconds kGiveAfter{2};

private:
    Session& session_;
    bool takes_over_;
    bool is_held_ = false;
    std::chrono::nanoseconds worked_{};  // when there last was work
};

}  // namespace lockstep::grbl
