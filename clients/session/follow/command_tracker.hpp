// Follows one command from its first sending to its answer: decides when it is sent, sent again and given up. A command
// that holds while it is renewed, a jog or the request of the lease, is also sent after its answer. Pure: the caller
// sends it, and passes the reply, the machine's owner and the time.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "clients/session/follow/owner_watch.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// The caller's next action. After Answered or GaveUp the command is never sent again.
enum class CommandStep : std::uint8_t { Wait, Send, Answered, GaveUp };

constexpr bool is_over(CommandStep step) { return step == CommandStep::Answered || step == CommandStep::GaveUp; }

class CommandTracker {
public:
    using Time = std::chrono::nanoseconds;

    static constexpr std::chrono::milliseconds kRepeatAfter{250};
    static constexpr std::chrono::milliseconds kRepeatStopAfter{20};  // for an emergency stop
    static constexpr std::chrono::milliseconds kRenewJogAfter{5};
    static constexpr std::chrono::seconds kPatience{3};
    static constexpr std::chrono::seconds kPlanPatience{60};  // an owner that plans a large program answers late
    static constexpr int kMostOwners = 4;                     // the patience begins again with each new owner
    static constexpr const char* kNoAnswer = "the coordinator does not answer";  // the reason of GaveUp

    /// `patience`: from the first sending to an owner until the command is given up. A command with a program waits
    /// kPlanPatience while the owner publishes states.
    explicit CommandTracker(const Command& command, Time patience = kPatience)
        : command_(command), patience_(patience) {}

    /// Call once, before the first pass().
    void number(Identity client, std::uint64_t sequence, std::uint64_t writer);
    bool is_numbered() const { return command_.sequence != 0; }
    const Command& command() const { return command_; }

    /// Call in each loop. `reply`: the newest to this command; null if none has come. `now`:
    /// OwnerWatch::running_time(). A command that is renewed is never Answered.
    CommandStep pass(const Reply* reply, const OwnerSight& owner, Time now);
    /// Sends it no more, and waits the patience at most for the answer: it may have begun already.
    void withdraw(Time now);
    /// The time until the next sending; nullopt if none will come.
    std::optional<Time> due_in(Time now) const;
    /// The newest answer, an acceptance or a refusal; nullopt before it.
    const std::optional<Reply>& reply() const { return reply_; }

private:
    enum class State : std::uint8_t { Sending, Withdrawn, GaveUp };
    /// How often it is sent; nullopt: no more.
    std::optional<Time> period() const;
    bool is_new_owner(const OwnerSight& owner) const;
    bool is_overdue(const OwnerSight& owner, Time now) const;
    bool is_due(const OwnerSight& owner, Time now) const;

    Command command_;
    Time patience_;
    State state_ = State::Sending;
    std::optional<Time> begun_;  // when the patience began
    std::optional<Time> sent_;
    Term owner_;      // at the latest sending
    int owners_ = 1;  // so many owners got the command
    std::optional<Reply> reply_;
};

}  // namespace lockstep
