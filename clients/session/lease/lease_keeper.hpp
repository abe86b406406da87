// A client's side of the writer's lease: decides when it is requested, kept and given back. Pure: the caller sends the
// commands, and passes the replies, the machine's owner and the time.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "clients/session/follow/command_tracker.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// A client that stays open gives the lease back after this time without work, so that other writers get the machine.
inline constexpr std::chrono::seconds kGiveLeaseAfter{2};

/// What the client's commands need of the lease now.
struct LeaseUse {
    bool wants = false;       // a command waits for the lease
    bool takes_over = false;  // one of them takes it from another writer, too
    bool has_work = false;    // a command, a jog or a job of this client is under way
};

class LeaseKeeper {
public:
    using Time = std::chrono::nanoseconds;
    /// Refused: another writer has the lease. Lost: it was held, and another writer has taken it over. Unanswered: the
    /// coordinator has not answered the request within CommandTracker::kPatience.
    enum class State : std::uint8_t { Free, Asked, Held, Refused, Lost, Unanswered };

    LeaseKeeper(Identity client, LeaseHolder writer) : client_(client) { write_as(std::move(writer)); }

    /// Sets the writer of later requests. Give the lease back first. An id of 0 stands for this client's identity,
    /// which no other client shares.
    void write_as(LeaseHolder writer);
    const LeaseHolder& writer() const { return writer_; }

    /// Call when the use may have changed; a client that stays open calls it in each loop. Requests the lease if a
    /// command waits for it, and gives it back after kGiveLeaseAfter without use. Refused, Lost and Unanswered hold
    /// until the next call: a later command requests the lease again.
    void use(const LeaseUse& use, Time now);
    /// Gives the lease back, or withdraws its request.
    void give();
    /// Call in each loop until it returns nullopt. Returns a command to send now. `now`: OwnerWatch::running_time().
    std::optional<Command> due(const OwnerSight& owner, Time now);
    /// Returns false if the reply answers something else.
    bool take_answer(const Reply& reply);

    State state() const { return state_; }
    bool is_held() const { return state_ == State::Held; }
    /// True if the commands that wait for the lease are refused; see answer(). `takes_over`: see LeaseUse.
    bool is_refused(bool takes_over) const { return state_ == State::Refused && takes_over_ >= takes_over; }
    /// The newest answer to the last request or give(); nullopt if none has come yet.
    const std::optional<Reply>& answer() const { return answer_; }

private:
    Command next_command(CommandKind kind);
    void ask(bool takes_over);

    Identity client_;
    LeaseHolder writer_;
    State state_ = State::Free;
    bool takes_over_ = false;  // the last request takes it from another writer
    std::uint64_t commands_ = 0;
    std::optional<CommandTracker> request_;
    std::optional<Command> giving_;  // not sent yet
    std::uint64_t sequence_ = 0;     // of the last request or give()
    std::optional<Reply> answer_;
    Time used_{};
};

}  // namespace lockstep
