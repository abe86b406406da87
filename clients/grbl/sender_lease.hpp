// The writer's lease of a sender. It is taken before the sender's first work and given back after kGiveLeaseAfter
// without work.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "clients/session/session.hpp"

namespace lockstep::grbl {

class SenderLease {
public:
    /// `takes_over`: takes the lease even from another writer.
    SenderLease(Session& session, bool takes_over) : session_(session), takes_over_(takes_over) {}

    /// Call before work. If the lease must be requested, waits for the coordinator's answer. Returns the refusal if
    /// another writer has the lease; nullopt if it is held, or if the coordinator is silent.
    std::optional<Reply> claim(std::chrono::nanoseconds now);
    /// Call in each loop. If the lease was lost, returns once a text that names the new writer; else nullopt.
    std::optional<std::string> pass(bool has_work, std::chrono::nanoseconds now);
    void give() { session_.give_lease(); }

private:
    Session& session_;
    bool takes_over_;
    bool is_held_ = false;
    std::chrono::nanoseconds worked_{};  // time of the latest work
};

}  // namespace lockstep::grbl
